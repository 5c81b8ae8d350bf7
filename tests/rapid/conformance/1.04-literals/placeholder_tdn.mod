! rule: <TDN> stands for a type definition
! source: [K §2.9]
MODULE Demo
    <TDN>
ENDMODULE
