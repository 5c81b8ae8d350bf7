MODULE undo_waits
    ! source: [S4 overview 3-23] [K §7.4] UNDO runs when a routine is aborted: not at the error, but when the pointer is moved
    ! case:
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: inner
    ! expect: outer
    ! state: finished
    ! case:
    ! do: start, run 1
    ! do: pp-to-main, run 1
    ! expect: undo inner 3
    ! expect: undo outer
    ! state: ready
    ! do: set bad 0, start, run 1
    ! expect: inner
    ! expect: outer
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        outer;
    ENDPROC
    PROC outer()
        inner;
        TPWrite "outer";
    UNDO
        TPWrite "undo outer";
    ENDPROC
    PROC inner()
        VAR num n := 3;
        fails;
        TPWrite "inner";
    UNDO
        TPWrite "undo inner " + ValToStr(n);
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
