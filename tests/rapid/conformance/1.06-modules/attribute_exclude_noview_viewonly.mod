! rule: the attribute list NOVIEW, VIEWONLY is wrong
! source: [K §9.1]
MODULE Demo(NOVIEW, VIEWONLY)  ! -> RG215
ENDMODULE
