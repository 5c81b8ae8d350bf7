! rule: the attribute list READONLY, SYSMODULE is wrong
! source: [K §9.1]
MODULE Demo(READONLY, SYSMODULE)  ! -> RG215
ENDMODULE
