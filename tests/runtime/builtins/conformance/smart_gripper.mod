MODULE smart_gripper
    ! source: [code] HandDriver.sys of kth-ros-pkg/yumi: checks, waits and errors; EIO.cfg of a YuMi [backup RW 6.15] for the signals
    ! signal: hand_CmdGripper_R GO 5
    ! signal: hand_ActualPosition_R GI 8
    ! signal: hand_StatusCalibrated_R DI
    ! signal: hand_CmdVacuum1_R DO
    ! signal: hand_CmdBlowoff1_R DO
    ! signal: hand_StatusVacuum1_R DI
    ! signal: hand_MaxSpeed_R GO 8
    ! expect: not calibrated
    ! expect: FALSE 0
    ! expect: TRUE 1
    ! 20 mm at 10 mm/s
    ! expect: 20 mm in 2 s, 200 100
    ! on its way after 1 s
    ! expect: 10 mm with 10 mm/s
    ! expect: 0 mm with 0 mm/s
    ! speeds are 3 to 25 mm/s
    ! expect: 25 mm in 1 s
    ! expect: 15 mm in 5 s
    ! expect: out of range
    ! expect: out of range
    ! nothing is between the fingers
    ! expect: 0 mm in 0.4 s
    ! expect: not there
    ! expect: behind
    ! expect: 15
    ! vacuum and air take turns, and nothing is at the cup
    ! expect: 0 1 1
    ! expect: 1 0 0
    ! expect: no vacuum
    ! expect: wrong state
    ! the other names, the other hand
    ! expect: FALSE
    ! expect: TRUE 12
    VAR clock since;
    PROC main()
        VAR num place;
        Hand_MoveTo 5;
        TPWrite ValToStr(Hand_IsCalibrated()) + " " + ValToStr(hand_StatusCalibrated_R);
        Hand_Initialize \maxSpd:=10 \holdForce:=15 \Calibrate;
        TPWrite ValToStr(Hand_IsCalibrated()) + " " + ValToStr(hand_StatusCalibrated_R);
        begin;
        Hand_MoveTo 20;
        place := Hand_GetActualPos();
        TPWrite ValToStr(place) + " mm in " + ValToStr(Round(ClkRead(since) \Dec:=1)) + " s, "
            + ValToStr(hand_ActualPosition_R) + " " + ValToStr(hand_MaxSpeed_R);
        Hand_MoveTo 0 \NoWait;
        WaitTime 1;
        TPWrite ValToStr(Round(g_GetPos())) + " mm with " + ValToStr(g_GetSpd()) + " mm/s";
        WaitTime 1.1;
        TPWrite ValToStr(g_GetPos()) + " mm with " + ValToStr(Hand_GetActualSpd()) + " mm/s";
        Hand_SetMaxSpeed 100;
        begin;
        Hand_GripOutward;
        tell;
        Hand_SetMaxSpeed 2;
        Hand_MoveTo 10 \NoWait;
        begin;
        Hand_WaitForExpectedState 6 \duration:=10;
        Hand_Stop;
        Hand_MoveTo 15 \NoWait;
        begin;
        WaitTime 5;
        Hand_Stop;
        tell;
        Hand_MoveTo 25.1;
        Hand_MoveTo -1;
        Hand_SetMaxSpeed 25;
        Hand_MoveTo 10;
        begin;
        g_GripIn \holdForce:=20 \NoWait;
        Hand_WaitForExpectedState 9;
        tell;
        Hand_MoveTo 10;
        Hand_GripInward \targetPos:=5, \posAlowance:=2;
        Hand_GripInward \targetPos:=15;
        Hand_MoveTo 15;
        TPWrite ValToStr(Hand_GetActualPos());
        Hand_TurnOnVacuum1;
        TPWrite ValToStr(hand_CmdBlowoff1_R) + " " + ValToStr(hand_StatusVacuum1_R) + " "
            + ValToStr(hand_CmdVacuum1_R);
        g_BlowOn1;
        TPWrite ValToStr(hand_CmdBlowoff1_R) + " " + ValToStr(hand_StatusVacuum1_R) + " "
            + ValToStr(hand_CmdVacuum1_R);
        g_VacuumOn1 \threshold:=50;
        Hand_SendCommand 9;
        Hand_WaitForExpectedState 9;
        Hand_CastChirality "L";
        TPWrite ValToStr(g_IsCalibrated());
        g_Calibrate \Jog;
        g_MoveTo 12;
        TPWrite ValToStr(g_IsCalibrated()) + " " + ValToStr(g_GetPos());
    ERROR
        TEST ERRNO
        CASE ERR_HAND_NOTCALIBRATED:
            TPWrite "not calibrated";
        CASE ERR_HAND_AUGOUTOFRANGE:
            TPWrite "out of range";
        CASE ERR_HAND_FAILEDGRIPPOS:
            TPWrite "not there";
        CASE ERR_HAND_FAILEDGRIPINWARD:
            TPWrite "behind";
        CASE ERR_HAND_FAILEDVACUUM:
            TPWrite "no vacuum";
        CASE ERR_HAND_WRONGSTATE:
            TPWrite "wrong state";
        ENDTEST
        TRYNEXT;
    ENDPROC
    PROC begin()
        ClkReset since;
        ClkStart since;
    ENDPROC
    PROC tell()
        TPWrite ValToStr(Hand_GetActualPos()) + " mm in " + ValToStr(Round(ClkRead(since) \Dec:=1)) + " s";
    ENDPROC
ENDMODULE
