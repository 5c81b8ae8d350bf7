! rule: numbers such as 3.5
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 3.5;
    ENDPROC
ENDMODULE
