! rule: the value has the type of the function
! source: [K §4.7]
MODULE Demo
    VAR num a;
    PROC main()
        a := f();
    ENDPROC
    FUNC num f()
        RETURN "1";  ! -> RG307
    ENDFUNC
ENDMODULE
