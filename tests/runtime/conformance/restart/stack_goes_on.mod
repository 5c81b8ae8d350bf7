MODULE stack_goes_on
    ! source: [S4 overview 3-23] every routine of the stack goes on
    ! dialect: unhandled_error=propagate
    ! do: start, run 1
    ! expect: twice
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: value 22
    ! expect: middle 10
    ! expect: main 110
    ! expect: twice
    ! expect: value 42
    ! expect: middle 20
    ! expect: main 220
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num r;
        FOR i FROM 1 TO 2 DO
            middle i, \back:=r;
            TPWrite "main " + ValToStr(i) + ValToStr(r);
        ENDFOR
    ENDPROC
    PROC middle(num a, \INOUT num back)
        VAR num k;
        k := a * 10;
        TPWrite "value " + ValToStr(1 + twice(k) + 1);
        back := k;
        TPWrite "middle " + ValToStr(k);
    ERROR
        RAISE;
    ENDPROC
    FUNC num twice(num v)
        VAR num own;
        own := v;
        TPWrite "twice";
        own := value(own) + own;
        RETURN own;
    ENDFUNC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
