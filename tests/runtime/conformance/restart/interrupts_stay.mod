MODULE interrupts_stay
    ! source: [S4 overview 3-23] [S4 overview 4-24] interrupts stay ordered; [4-39] what happens while it stands is lost
    ! do: start, run 1, set p 1, set bad 0, start, run 2
    ! expect: trap 2
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    VAR intnum i;
    PERS num p := 0;
    TRAP t
        TPWrite "trap " + ValToStr(p);
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        IPers p, i;
        fails;
        p := 2;
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
