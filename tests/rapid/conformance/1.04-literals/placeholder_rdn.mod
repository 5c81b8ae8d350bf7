! rule: <RDN> stands for a routine
! source: [K §2.9]
MODULE Demo
    <RDN>
ENDMODULE
