! rule: numbers such as 2e+3
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 2e+3;
    ENDPROC
ENDMODULE
