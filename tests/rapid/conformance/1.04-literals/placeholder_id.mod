! rule: <ID> stands for a name
! source: [K §2.3, 2.9]
MODULE Demo
    VAR num <ID>;
    PROC main()
        <ID>;
        <ID>:
        GOTO <ID>;
    ENDPROC
ENDMODULE
