MODULE trigg_data
    ! source: 3HAC050917 TriggDataReset, TriggDataCopy, TriggDataValid [manual]
    ! robot: irb120
    ! signal: doFirst DO
    ! signal: doSecond DO
    ! expect: FALSE
    ! expect: TRUE TRUE
    ! expect: FALSE TRUE
    ! expect: 1 0
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR triggdata one;
    VAR triggdata other;

    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        TPWrite ValToStr(TriggDataValid(one));
        TriggIO one, 20 \DOp:=doFirst, 1;
        TriggDataCopy one, other;
        TPWrite ValToStr(TriggDataValid(one)) + " " + ValToStr(TriggDataValid(other));
        TriggDataReset one;
        TPWrite ValToStr(TriggDataValid(one)) + " " + ValToStr(TriggDataValid(other));
        TriggIO one, 20 \DOp:=doSecond, 1;
        TriggL Offs(p,0,60,0), v200, other, fine, tool0;
        TPWrite ValToStr(DOutput(doFirst)) + " " + ValToStr(DOutput(doSecond));
    ENDPROC
ENDMODULE
