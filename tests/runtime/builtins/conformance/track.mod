MODULE track
    ! source: [manual] S4 MoveExtJ, EOffsSet, GetNextMechUnit, DeactUnit, ActUnit: an external axis
    ! robot: irb120_track
    ! expect: 400 0
    ! expect: 450
    ! expect: ROB_1 TRUE 6
    ! expect: TRACK_1 FALSE 1
    ! expect: STN_1 FALSE 1
    ! expect: off
    ! expect: 0
    ! expect: 100
    VAR jointtarget j;
    VAR num n;
    VAR string name;
    VAR bool robot;
    VAR num count;
    PROC main()
        j := CJointT();
        j.extax.eax_a := 300;
        MoveAbsJ j, v1000, fine, tool0;
        j.extax.eax_a := 400;
        MoveExtJ j, vlin100, fine;
        j := CJointT();
        TPWrite ValToStr(Round(j.extax.eax_a \Dec:=3)) + " " + ValToStr(Round(j.robax.rax_1 \Dec:=3));
        EOffsSet [50,0,9E9,9E9,9E9,9E9];
        j.extax.eax_a := 400;
        MoveAbsJ j, v1000, fine, tool0;
        EOffsOff;
        tell;
        WHILE GetNextMechUnit(n, name \TCPRob:=robot \NoOfAxes:=count) DO
            TPWrite name + " " + ValToStr(robot) + " " + ValToStr(count);
        ENDWHILE
        j := CJointT();
        j.extax.eax_a := 0;
        MoveAbsJ j, v1000, fine, tool0;
        j.extax.eax_a := 100;
        DeactUnit TRACK_1;
        IF NOT IsMechUnitActive(TRACK_1) TPWrite "off";
        MoveAbsJ j, v1000, fine, tool0;
        tell;
        ActUnit TRACK_1;
        j.extax.eax_a := 100;
        MoveAbsJ j, v1000, fine, tool0;
        tell;
    ENDPROC
    PROC tell()
        j := CJointT();
        TPWrite ValToStr(Round(j.extax.eax_a \Dec:=3));
    ENDPROC
ENDMODULE
