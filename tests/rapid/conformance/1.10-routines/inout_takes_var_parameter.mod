! rule: an VAR parameter as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(VAR num x)
        p x;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
