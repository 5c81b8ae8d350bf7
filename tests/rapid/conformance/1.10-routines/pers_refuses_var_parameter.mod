! rule: an VAR parameter as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(VAR num x)
        p x;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
