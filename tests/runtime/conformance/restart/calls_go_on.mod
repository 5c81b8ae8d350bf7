MODULE calls_go_on
    ! source: [S4 overview 3-23] a call that is not made again changes no other; late bound calls and recursion go on
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: first
    ! expect: second
    ! do: set bad 1, run 1
    ! expect: inner
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 5
    ! expect: main
    ! do: set bad 1, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 10
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        IF bad > 0 inner "first";
        inner "second";
        WaitTime 1.5;
        %"late"% 5;
        TPWrite "main";
        WaitTime 1.5;
        TPWrite ValToStr(sum(4));
    ENDPROC
    PROC inner(string s)
        fails;
        TPWrite s;
    ENDPROC
    PROC late(num n)
        TPWrite "inner";
        fails;
        TPWrite ValToStr(n);
    ENDPROC
    FUNC num sum(num n)
        IF n = 0 RETURN value(0);
        RETURN n + sum(n - 1);
    ENDFUNC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
