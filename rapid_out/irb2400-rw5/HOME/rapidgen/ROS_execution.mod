MODULE ROS_execution
    ! Programs: their instructions, executed one after the other.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! In the motion task. All was checked before it came into the ring; ROS_motion takes it out there, and
    ! leaves an instruction that is under way when the robot was stopped.

    CONST string ROS_BUILD_EXECUTION := "8a237425283c";

    ! The instruction at hand, and why it could not be carried out, 0: it could.
    VAR ROS_order ROS_ordered;
    VAR num ROS_order_fault := 0;
    LOCAL VAR zonedata zone;
    LOCAL VAR speeddata speed;
    ! What is other than usual on lines.
    LOCAL VAR num ways := 0;
    ! The customer's program displaces poses (PDispOn, EOffsOn): they would be others than those checked.
    LOCAL VAR bool displaced := FALSE;
    LOCAL CONST extjoint UNMOVED := [0,0,0,0,0,0];
    ! mm, and of a quaternion at 1 m: as much as rounding may be.
    LOCAL CONST num STILL := 0.01;
    TASK PERS tooldata ROS_own_tool := [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata ROS_own_wobj := [FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

    ! What holds at the beginning of each program: the path is the one that was checked, or none.
    PROC ROS_prepare_program()
        ConfJ \On;
        set_ways 0;
        look_for_displacement;
    ENDPROC

    ! What is asked of a displacement is where it leaves a pose that is nowhere.
    LOCAL PROC look_for_displacement()
        VAR robtarget zero := [[0,0,0],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]];

        zero := ORobT(zero);
        displaced := VectMagn(zero.trans) > STILL OR zero.extax <> UNMOVED
            OR Abs(zero.rot.q2) + Abs(zero.rot.q3) + Abs(zero.rot.q4) > STILL / 1000;
    ENDPROC

    ! A program that asked for other ways is over.
    PROC ROS_plain_ways()
        IF ways <> 0 set_ways 0;
    ENDPROC

    ! 1: the wrist may turn on lines as it likes, 2: any configuration; both, or none.
    LOCAL PROC set_ways(num bits)
        ways := bits;
        IF bits MOD 2 = 1 THEN
            SingArea \Wrist;
        ELSE
            SingArea \Off;
        ENDIF
        IF bits DIV 2 = 1 THEN
            ConfL \Off;
        ELSE
            ConfL \On;
        ENDIF
    ENDPROC

    ! Take the instruction at a place of the ring to hand.
    PROC ROS_fetch_order(num place)
        ROS_ordered := ROS_orders{place};
    ENDPROC

    ! TRUE if the robot stands at the end of the instruction at hand; `next` is the number of the one
    ! behind it. Without one it does, where one of the two does not move, and before another tool.
    FUNC bool ROS_order_stops(num next)
        VAR num place;

        IF ROS_ordered.kind > ROS_DO_MOVE_C OR ROS_ordered.zone.finep OR next = ROS_head RETURN TRUE;
        place := next MOD ROS_RING_SIZE + 1;
        IF ROS_orders{place}.kind > ROS_DO_MOVE_C RETURN TRUE;
        RETURN ROS_orders{place}.tool <> ROS_ordered.tool OR ROS_orders{place}.wobj <> ROS_ordered.wobj;
    ENDFUNC

    ! What is left of the move at hand: a stop where it ends, without its signals.
    PROC ROS_end_way()
        IF ROS_ordered.kind = ROS_DO_MOVE_C ROS_ordered.kind := ROS_DO_MOVE_L;
        ROS_ordered.marks := 0;
    ENDPROC

    PROC ROS_execute(bool stops, num percent)
        ROS_order_fault := ROS_REASON_NONE;
        TEST ROS_ordered.kind
        CASE ROS_DO_SETTINGS:
            set_ways ROS_ordered.value;
            RETURN;
        CASE ROS_DO_TOOL:
            ! The robot stands: no move is under way with what it was.
            ROS_own_tool := [TRUE,[ROS_ordered.target.trans,ROS_ordered.target.rot],ROS_ordered.load];
            RETURN;
        CASE ROS_DO_WORK_OBJECT:
            ROS_own_wobj := [FALSE,TRUE,"",[ROS_ordered.target.trans,ROS_ordered.target.rot],
                [ROS_ordered.via.trans,ROS_ordered.via.rot]];
            RETURN;
        CASE ROS_DO_WAIT:
            WaitTime ROS_ordered.seconds;
            RETURN;
        ENDTEST
        IF displaced AND ROS_ordered.kind <> ROS_DO_MOVE_ABSJ THEN
            ROS_order_fault := ROS_REASON_POSE_MISMATCH;
            ErrWrite "ROS: poses are displaced", "A program displacement or offset is in force, and nobody has checked"
                \RL2:="where it takes the robot." \RL3:="PDispOff, EOffsOff";
            RETURN;
        ENDIF
        zone := ROS_ordered.zone;
        IF stops zone := fine;
        speed := ROS_ordered.speed;
        speed.v_tcp := speed.v_tcp * percent / 100;
        speed.v_ori := speed.v_ori * percent / 100;
        speed.v_leax := speed.v_leax * percent / 100;
        speed.v_reax := speed.v_reax * percent / 100;
        TEST ROS_ordered.tool
        CASE 0:
            move_with torch;
        CASE 1:
            move_with ROS_own_tool;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC move_with(PERS tooldata tool)
        TEST ROS_ordered.wobj
        CASE 0:
            move tool, table;
        CASE 1:
            move tool, ROS_own_wobj;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC move(PERS tooldata tool, PERS wobjdata wobj)
        TEST ROS_ordered.kind
        CASE ROS_DO_MOVE_ABSJ:
            MoveAbsJ ROS_ordered.joints \NoEOffs, speed, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_J:
            MoveJ ROS_ordered.target, speed, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_L:
            MoveL ROS_ordered.target, speed, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_C:
            MoveC ROS_ordered.via, ROS_ordered.target, speed, zone, tool \WObj:=wobj;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
