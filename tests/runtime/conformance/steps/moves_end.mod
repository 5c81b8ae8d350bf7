MODULE moves_end
    ! source: [mem] each step is a stop point: a move ends before the step does
    ! robot: irb120
    ! do: step
    ! at: main MoveAbsJ b, v1000, z50, tool0;
    ! do: service look, run 0.1
    ! expect: 20
    ! do: run 1, service look, run 0.1
    ! expect: 20
    ! do: step, run 3, service look, run 0.1
    ! expect: 0
    CONST jointtarget a := [[20,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget b := [[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveAbsJ a, v1000, z50, tool0;
        MoveAbsJ b, v1000, z50, tool0;
    ENDPROC
    PROC look()
        VAR jointtarget here;
        here := CJointT();
        TPWrite ValToStr(Round(here.robax.rax_1 \Dec:=2));
    ENDPROC
ENDMODULE
