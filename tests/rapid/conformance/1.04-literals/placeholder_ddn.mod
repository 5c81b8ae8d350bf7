! rule: <DDN> stands for a data declaration
! source: [K §2.9]
MODULE Demo
    <DDN>
ENDMODULE
