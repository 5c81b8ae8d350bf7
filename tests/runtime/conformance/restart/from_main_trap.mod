MODULE from_main_trap
    ! source: [S4 overview 3-23] [mem] in a trap, it starts from main only
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
    VAR intnum i;
    TRAP t
        fails;
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        ITimer 0.1, i;
        WaitTime 1;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
