! rule: the attribute list SYSMODULE
! source: [K §9.1]
MODULE Demo(SYSMODULE)
ENDMODULE
