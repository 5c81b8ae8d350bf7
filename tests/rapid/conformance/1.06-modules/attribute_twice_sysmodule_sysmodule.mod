! rule: the attribute list SYSMODULE, SYSMODULE is wrong
! source: [K §9.1]
MODULE Demo(SYSMODULE, SYSMODULE)  ! -> RG215
ENDMODULE
