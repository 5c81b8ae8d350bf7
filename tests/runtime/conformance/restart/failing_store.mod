MODULE failing_store
    ! source: [S4 overview 3-23] a store that fails leaves its target
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 3E+38
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num x := 3E38;
        VAR num y := 2;
        IF bad = 0 y := 1;
        x := x * y * (2 - (1 * factor()));
        TPWrite ValToStr(x);
    ENDPROC
    FUNC num factor()
        IF bad > 0 RETURN 0;
        RETURN 1.5;
    ENDFUNC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
