MODULE moves_go_on
    ! source: [S4 overview 3-23] moves behind the statement are made
    ! robot: irb120
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 9
    ! expect: 20
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    CONST jointtarget there := [[20,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        VAR jointtarget here;
        fails;
        MoveAbsJ there, v1000, fine, tool0;
        here := CJointT();
        TPWrite ValToStr(Round(here.robax.rax_1 \Dec:=3));
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
