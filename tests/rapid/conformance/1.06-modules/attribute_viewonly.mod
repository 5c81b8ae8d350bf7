! rule: the attribute list VIEWONLY
! source: [K §9.1]
MODULE Demo(VIEWONLY)
ENDMODULE
