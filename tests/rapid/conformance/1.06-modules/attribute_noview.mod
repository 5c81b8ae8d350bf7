! rule: the attribute list NOVIEW
! source: [K §9.1]
MODULE Demo(NOVIEW)
ENDMODULE
