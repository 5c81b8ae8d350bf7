! rule: a comment may contain tabs
! source: [K §2.10]
MODULE Demo
    !	a	b
ENDMODULE
