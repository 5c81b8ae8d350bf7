! rule: a FUNC returns on every way
! source: [K §5.4]
MODULE Demo
    VAR num a;
    PROC main()
        a := f(1);
    ENDPROC
    FUNC num f(num x)  ! -> RG322~
        IF x > 0 RETURN 1;
    ENDFUNC
ENDMODULE
