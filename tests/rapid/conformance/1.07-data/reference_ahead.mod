! rule: data of a module are known in the whole module
! source: [K §2.20]
MODULE Demo
    VAR num a := b;
    CONST num b := 2;
    PROC main()
        a := later();
    ENDPROC
    FUNC num later()
        RETURN a;
    ENDFUNC
ENDMODULE
