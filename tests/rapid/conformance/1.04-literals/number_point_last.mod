! rule: numbers such as 38.
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 38.;
    ENDPROC
ENDMODULE
