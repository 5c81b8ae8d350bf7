!=== arc_welding
MODULE arc_welding
    ! source: [manual] 3HAC050988 phases of seamdata, speed by welddata; PROC.cfg [code] for the signals
    ! robot: irb120
    ! signal: doGas DO
    ! signal: doWeld DO
    ! signal: doFeed DO
    ! signal: diArc DI
    ! signal: siInhibit DI
    ! signal: aoVolt AO
    ! signal: goJob GO 8
    ! signal: doPlace DO
    ! arc: GasOn doGas
    ! arc: WeldOn doWeld
    ! arc: FeedOn doFeed
    ! arc: ArcEst diArc
    ! arc: WeldInhib siInhibit
    ! arc: VoltReference aoVolt
    ! arc: SchedulePort goJob
    ! do: start, run 20, signal siInhibit 1, run 5
    ! 0.5 s of gas on a way that takes longer, and 0.3 s more at the start, before the arc
    ! expect: gas
    ! expect: at the start after 0.8 s of gas
    ! expect: arc 22 3
    ! 60 mm at 20 mm/s, whatever Speed says
    ! expect: seam in 3 s
    ! expect: place
    ! filling for 0.4 s with its data, then gas for 0.2 s
    ! expect: crater 15 4
    ! expect: end after 1.7 s, gas 0, arc 0
    ! expect: does not fit
    ! a start in a corner burns from its middle on, an end there to its middle
    ! expect: arc 22 3
    ! expect: flying 1 1
    ! expect: out 0 0
    ! without a start the robot stands for the gas, and begins
    ! expect: gas
    ! expect: arc 22 3
    ! inhibited: Speed holds, nothing burns
    ! expect: 60 mm at 200 mm/s, arc 0
    ! expect: arc off
    ! log: 194905 weaving is not simulated: the tool goes along the seam at its speed
    ! a program that stands has no arc, nor one that was given up
    ! do: pp-to-main, signal siInhibit 0, routine long, start, run 1
    ! value: doWeld = 1
    ! do: stop, run 1
    ! value: doWeld = 0
    ! do: start, run 1
    ! value: doWeld = 1
    ! value: doGas = 1
    ! do: stop, run 1, pp-to-main, start, run 0.1
    ! value: doWeld = 0
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    TASK PERS seamdata seam := [0.5,0.3,[0,0,0,0,0,0,0,0,0],0,0,0,0,0,[0,0,0,0,0,0,0,0,0],0,
        0.4,[4,0,15,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0.2];
    TASK PERS seamdata quick := [0,0,[0,0,0,0,0,0,0,0,0],0,0,0,0,0,[0,0,0,0,0,0,0,0,0],0,
        0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0];
    TASK PERS welddata bead := [20,0,[3,0,22,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];
    TASK PERS welddata wrong := [20,0,[300,0,22,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];
    TASK PERS weavedata zigzag := [1,0,3,4,0,0,0,0,0,0,0,0,0,0,0];
    TASK PERS trackdata none := [0,FALSE,50,[0,0,0,0,0,0,0,0,0],[0,0,0,0,0,0,0]];
    VAR clock gas_since;
    VAR clock since;
    VAR intnum i;
    VAR intnum j;
    VAR intnum k;
    VAR intnum l;
    VAR triggdata place;
    TRAP gas
        TPWrite "gas";
        ClkReset gas_since;
        ClkStart gas_since;
    ENDTRAP
    TRAP arc
        TPWrite "arc " + ValToStr(aoVolt) + " " + ValToStr(goJob);
    ENDTRAP
    TRAP crater
        TPWrite "crater " + ValToStr(aoVolt) + " " + ValToStr(goJob);
    ENDTRAP
    TRAP placed
        TPWrite "place";
    ENDTRAP
    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        CONNECT i WITH gas;
        ISignalDO doGas, 1, i;
        CONNECT j WITH arc;
        ISignalDO doWeld, 1, j;
        ArcMoveL Offs(p,0,-100,0), v200, fine, tool0;
        ArcLStart p, v100, seam, bead \Weave:=zigzag, fine, tool0 \WObj:=wobj0 \SeamName:="first";
        TPWrite "at the start after " + ValToStr(Round(ClkRead(gas_since) \Dec:=1)) + " s of gas";
        CONNECT k WITH crater;
        ISignalGO goJob, k;
        CONNECT l WITH placed;
        TriggInt place, 10, l;
        begin;
        ArcL Offs(p,0,60,0), v1000, seam, bead \Weave:=zigzag, fine, tool0 \Track:=none;
        TPWrite "seam in " + ValToStr(Round(ClkRead(since))) + " s";
        begin;
        ArcLEnd Offs(p,0,60,20), v1000, seam, bead, fine, tool0 \T1:=place;
        TPWrite "end after " + ValToStr(Round(ClkRead(since) \Dec:=1)) + " s, gas " + ValToStr(doGas)
            + ", arc " + ValToStr(diArc);
        IDelete k;
        IDelete i;
        ArcL p, v1000, seam, wrong, fine, tool0;
        ArcLStart Offs(p,0,30,20), v200, quick, bead, z10, tool0;
        ArcC Offs(p,0,20,10), Offs(p,0,10,20), v200, quick, bead, z1, tool0;
        WaitUntil doWeld = 1 \PollRate:=0.01;
        TPWrite "flying " + ValToStr(doGas) + " " + ValToStr(doWeld);
        ArcLEnd Offs(p,0,-10,20), v200, quick, bead, z10, tool0;
        MoveL Offs(p,0,-10,60), v200, fine, tool0;
        TPWrite "out " + ValToStr(doGas) + " " + ValToStr(doWeld);
        CONNECT i WITH gas;
        ISignalDO doGas, 1, i;
        ArcL Offs(p,0,0,60), v200, quick, bead, fine, tool0;
        ArcLEnd p, v200, quick, bead, fine, tool0;
        SetDO doPlace, 1;
        WaitDI siInhibit, 1;
        begin;
        ArcL Offs(p,0,60,0), v200, quick, bead, fine, tool0;
        IF ClkRead(since) < 0.5 TPWrite "60 mm at 200 mm/s, arc " + ValToStr(doWeld);
        ArcLEnd p, v200, quick, bead, fine, tool0;
        TPWrite "arc off";
    ERROR
        IF ERRNO = ERR_GO_LIM TPWrite "does not fit";
        TRYNEXT;
    ENDPROC
    PROC long()
        MoveAbsJ start, v1000, fine, tool0;
        ArcLStart p, v100, quick, bead, fine, tool0;
        ArcLEnd Offs(p,0,60,0), v1000, quick, bead, fine, tool0;
    ENDPROC
    PROC begin()
        ClkReset since;
        ClkStart since;
    ENDPROC
ENDMODULE
!=== hands_calibrated
MODULE hands_calibrated
    ! source: [code] HandDriver.sys asks for a calibration; one by a program before is a switch (`hands_calibrated`)
    ! case: hands_calibrated=false
    ! expect: not calibrated
    ! case: hands_calibrated=true
    ! expect: 10
    PROC main()
        g_MoveTo 10;
        TPWrite ValToStr(g_GetPos());
    ERROR
        IF ERRNO = ERR_HAND_NOTCALIBRATED TPWrite "not calibrated";
        RETURN;
    ENDPROC
ENDMODULE
!=== option_records
MODULE option_records
    ! source: abb-rapidserver [code] declares a sensor as an aggregate of three; components [manual]
    ! expect: 2 [0,0,2]
    PERS sensor host := [0,0,2];
    PROC main()
        TPWrite ValToStr(host.state) + " " + ValToStr(host);
    ENDPROC
ENDMODULE
!=== smart_gripper
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
