MODULE move_in_background
    ! source: [S4 overview 4-48] moves are a motion task's
    ! robot: irb120
    ! task: T_BACK back SEMISTATIC
    ! do: start, run 1
    ! expect: at 0
    ! state: running error
    ! fault: 49901 11
    CONST jointtarget there := [[10,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC back()
        MoveAbsJ there, v100, fine, tool0;
    ENDPROC
    PROC main()
        VAR jointtarget here;
        WaitTime 0.5;
        here := CJointT();
        TPWrite "at " + ValToStr(here.robax.rax_1);
        WaitTime 9;
    ENDPROC
ENDMODULE
