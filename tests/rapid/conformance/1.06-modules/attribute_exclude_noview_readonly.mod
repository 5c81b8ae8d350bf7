! rule: the attribute list NOVIEW, READONLY is wrong
! source: [K §9.1]
MODULE Demo(NOVIEW, READONLY)  ! -> RG215
ENDMODULE
