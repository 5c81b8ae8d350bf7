! rule: TRUE and FALSE
! source: [K §2.6]
MODULE Demo
    VAR bool a;
    PROC main()
        a := TRUE;
        a := false;
    ENDPROC
ENDMODULE
