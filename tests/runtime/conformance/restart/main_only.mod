MODULE main_only
    ! source: [S4 overview 3-23] [mem] the other behaviour: after an error it starts from main only
    ! dialect: after_error=main
    ! do: start, run 1
    ! log: 40199 main_only/fails/18
    ! do: set bad 0, start, run 1
    ! log: 40199
    ! state: error
    ! fault: ERR_OUTOFBND 18
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        fails;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
