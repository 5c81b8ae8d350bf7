MODULE from_main_goto
    ! source: [S4 overview 3-23] [mem] where GOTO may lead, it starts from main only
    ! do: start, run 2
    ! state: error
    ! do: set bad 0, start, run 2
    ! state: error
    ! log: 40001 a routine with GOTO cannot go on in the middle: PP to main
    ! do: pp-to-main, start, run 2
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num n;
        again:
        fails;
        IF n > 1 GOTO again;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
