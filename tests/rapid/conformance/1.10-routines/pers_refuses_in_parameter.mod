! rule: an IN parameter as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(num x)
        p x;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
