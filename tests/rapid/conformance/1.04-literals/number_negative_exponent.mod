! rule: numbers such as 2.5E-3
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 2.5E-3;
    ENDPROC
ENDMODULE
