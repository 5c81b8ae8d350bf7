! rule: numbers such as .27
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := .27;
    ENDPROC
ENDMODULE
