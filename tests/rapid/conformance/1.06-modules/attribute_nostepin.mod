! rule: the attribute list NOSTEPIN
! source: [K §9.1]
MODULE Demo(NOSTEPIN)
ENDMODULE
