! rule: a FUNC returns a value
! source: [K §4.7]
MODULE Demo
    VAR num a;
    PROC main()
        a := f();
    ENDPROC
    FUNC num f()
        RETURN;  ! -> RG321
    ENDFUNC
ENDMODULE
