! rule: the attribute list VIEWONLY, READONLY is wrong
! source: [K §9.1]
MODULE Demo(VIEWONLY, READONLY)  ! -> RG215
ENDMODULE
