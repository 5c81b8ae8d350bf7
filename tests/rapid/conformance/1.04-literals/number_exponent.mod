! rule: numbers such as 3E2
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 3E2;
    ENDPROC
ENDMODULE
