MODULE pp_to_main
    ! source: [S4 overview 4-24] it initialises variables, keeps persistents and runs UNDO
    ! do: start, run 1, stop, pp-to-main, run 0.1
    ! expect: 22
    ! expect: undo
    ! state: ready
    ! log: 10002
    ! do: start, run 1
    ! expect: 23
    VAR num v := 1;
    PERS num p := 1;
    PROC main()
        v := v + 1;
        p := p + 1;
        TPWrite ValToStr(v) + ValToStr(p);
        inner;
    ENDPROC
    PROC inner()
        WaitTime 100;
    UNDO
        TPWrite "undo";
    ENDPROC
ENDMODULE
