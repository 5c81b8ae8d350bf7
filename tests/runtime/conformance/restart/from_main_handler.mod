MODULE from_main_handler
    ! source: [S4 overview 3-23] [mem] in a handler, it starts from main only
    ! dialect: unhandled_error=propagate
    ! do: start, run 2
    ! state: error
    ! do: set bad 0, start, run 2
    ! state: error
    ! log: 10126 PP to main first
    ! do: pp-to-main, start, run 2
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        fails;
    ERROR
        fails;
        TRYNEXT;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
