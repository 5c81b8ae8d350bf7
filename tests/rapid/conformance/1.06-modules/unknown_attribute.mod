! rule: there are five attributes
! source: [K §9.1]
MODULE Demo(SYSTEM)  ! -> RG201
ENDMODULE
