! rule: the attribute list READONLY
! source: [K §9.1]
MODULE Demo(READONLY)
ENDMODULE
