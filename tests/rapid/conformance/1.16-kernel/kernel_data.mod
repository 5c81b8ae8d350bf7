! rule: ERRNO and INTNO
! source: [K §12]
! given: system
MODULE Demo
    VAR num a;
    PROC main()
        a := ERRNO;
        a := INTNO;
    ENDPROC
ENDMODULE
