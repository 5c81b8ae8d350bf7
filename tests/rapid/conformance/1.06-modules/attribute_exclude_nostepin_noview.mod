! rule: the attribute list NOSTEPIN, NOVIEW is wrong
! source: [K §9.1]
MODULE Demo(NOSTEPIN, NOVIEW)  ! -> RG215
ENDMODULE
