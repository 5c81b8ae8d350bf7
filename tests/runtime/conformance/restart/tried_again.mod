MODULE tried_again
    ! source: [S4 overview 3-23] the faulty statement is tried again, variables are kept
    ! case:
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 67894
    ! state: finished
    ! case:
    ! do: set bad 3, start, run 1, set bad 2, start, run 1, set bad 1, start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 67894
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    VAR num global := 1;
    PROC main()
        VAR num n := 5;
        VAR pos p := [1,2,3];
        VAR num list{3} := [1,2,3];
        CONST num c := 4;
        n := 6;
        p.x := 7;
        list{2} := 8;
        global := 9;
        fails;
        TPWrite ValToStr(n) + ValToStr(p.x) + ValToStr(list{2}) + ValToStr(global) + ValToStr(c);
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
