! rule: an PERS parameter as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(PERS num x)
        p x;  ! -> RG315
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
