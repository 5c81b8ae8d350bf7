! rule: an IN parameter as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(num x)
        p x;
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
