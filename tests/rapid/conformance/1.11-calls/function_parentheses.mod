! rule: a function has parentheses
! source: [K §3.10]
MODULE Demo
    VAR num a;
    PROC main()
        a := f;  ! -> RG306
        a := f();
    ENDPROC
    FUNC num f()
        RETURN 1;
    ENDFUNC
ENDMODULE
