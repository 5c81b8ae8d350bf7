MODULE touching
    ! source: [manual] 3HAC050917 ContactL, GetJointData, MaxRobReorientSpeed, CornerPathWarning; SetLeadThrough as public notes of it; [code] HandDriver.sys for EventLog
    ! robot: irb120
    ! do: start, run 30
    ! expect: 500 5000 1000
    ! nothing is touched: with a torque that is an error
    ! expect: 60
    ! expect: no contact
    ! expect: 0
    ! 100 mm/s, the wrist about 305 mm from axis 1
    ! expect: axis 1 turns
    ! expect: 30 0 0 0
    ! led by hand: the robot stands, the path is gone behind
    ! expect: TRUE TRUE TRUE
    ! expect: FALSE FALSE
    ! expect: there
    ! log: 112753 L
    ! warned of one corner, not of the other one
    ! do: pp-to-main, routine warned, start, run 3
    ! log: 50024 rob1: the corner is executed as a stop point (touching/corner/75)
    ! do: pp-to-main, routine not_warned, start, run 3
    ! log: 50024
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR num place;
    VAR num speed;
    VAR num torque;
    VAR num outer;
    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        TPWrite ValToStr(MaxRobReorientSpeed()) + " " + ValToStr(MaxExtLinearSpeed()) + " "
            + ValToStr(MaxExtReorientSpeed());
        ContactL Offs(p,0,60,0), v100, tool0;
        tell;
        ContactL \DesiredTorque:=5, p, v100, \Zone:=z1, tool0, \WObj:=wobj0;
        tell;
        MoveL \Conc, Offs(p,0,100,0), v100, fine, tool0;
        WaitTime 0.5;
        GetJointData 1 \Position:=place \Speed:=speed;
        IF place > 8 AND place < 9 AND speed > 18 AND speed < 19 TPWrite "axis 1 turns";
        WaitRob \InPos;
        MoveAbsJ start, v1000, fine, tool0;
        GetJointData \MechUnit:=ROB_1, 5 \Position:=place \Speed:=speed \Torque:=torque \ExtTorque:=outer;
        TPWrite ValToStr(place) + " " + ValToStr(speed) + " " + ValToStr(torque) + " " + ValToStr(outer);
        MoveL \Conc, Offs(p,0,100,0), v100, fine, tool0;
        WaitTime 0.2;
        SetLeadThrough \On;
        WaitTime 1;
        TPWrite ValToStr(IsLeadThrough()) + " " + ValToStr(IsLeadThrough(\Active)) + " "
            + ValToStr(IsStopMoveAct(\FromMoveTask));
        SetLeadThrough \Off;
        TPWrite ValToStr(IsLeadThrough(\Set)) + " " + ValToStr(IsStopMoveAct(\FromMoveTask));
        MoveL p, v100, fine, tool0;
        TPWrite "there";
        EventLog COMMON_ERR, 0, TYPE_STATE, "", "", "", "", "";
        EventLog 11, 2753, TYPE_ERR, ERRSTR_TASK, "L", ERRSTR_CONTEXT, ERRSTR_UNUSED, ERRSTR_UNUSED;
    ERROR
        IF ERRNO = ERR_CONTACTL TPWrite "no contact";
        TRYNEXT;
    ENDPROC
    PROC tell()
        VAR pos here;
        here := CPos(\Tool:=tool0 \WObj:=wobj0);
        TPWrite ValToStr(Round(here.y \Dec:=2));
    ENDPROC
    PROC warned()
        corner;
    ENDPROC
    PROC not_warned()
        CornerPathWarning FALSE;
        corner;
    ENDPROC
    PROC corner()
        MoveAbsJ start, v1000, fine, tool0;
        MoveL Offs(p,0,50,0), v100, z10, tool0;
        WaitTime 1;
    ENDPROC
ENDMODULE
