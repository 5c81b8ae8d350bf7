! rule: a FUNC has a RETURN
! source: [K §5.4, 12]
MODULE Demo
    VAR num a;
    PROC main()
        a := f();
    ENDPROC
    FUNC num f()  ! -> RG322?
    ENDFUNC
ENDMODULE
