! rule: the attribute list NOSTEPIN, READONLY
! source: [K §9.1]
MODULE Demo(NOSTEPIN, READONLY)
ENDMODULE
