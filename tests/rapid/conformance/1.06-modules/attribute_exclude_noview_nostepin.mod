! rule: the attribute list NOVIEW, NOSTEPIN is wrong
! source: [K §9.1]
MODULE Demo(NOVIEW, NOSTEPIN)  ! -> RG215
ENDMODULE
