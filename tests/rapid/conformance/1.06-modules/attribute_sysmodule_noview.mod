! rule: the attribute list SYSMODULE, NOVIEW
! source: [K §9.1]
MODULE Demo(SYSMODULE, NOVIEW)
ENDMODULE
