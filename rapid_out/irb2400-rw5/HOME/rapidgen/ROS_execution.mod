MODULE ROS_execution
    ! Programs: execution of their instructions.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! This module belongs to the motion task. All checks were made before an instruction was put into
    ! the ring buffer. ROS_motion takes it out, and leaves it by a long jump if the robot was stopped.

    CONST string ROS_BUILD_EXECUTION := "a68c3bfb8285";

    ! Present instruction, and the reason why it failed (0: it did not).
    VAR ROS_instr ROS_current_instr;
    VAR num ROS_instr_fault := 0;
    LOCAL VAR zonedata zone;
    LOCAL VAR speeddata speed;
    ! Present bits of set_path_mode.
    LOCAL VAR num path_mode := 0;
    ! TRUE if the user's program displaces poses (PDispOn, EOffsOn), so that they differ from the
    ! checked ones.
    LOCAL VAR bool is_displaced := FALSE;
    LOCAL CONST extjoint ZERO_EXTAX := [0,0,0,0,0,0];
    ! Displacements below this are rounding errors: mm, and 0.001 of it for a quaternion.
    LOCAL CONST num DISPLACEMENT_TOL := 0.01;
    ! Tools and work objects of the configuration; ROS_own_tool and ROS_own_wobj hold those that the client
    ! defines. They are copies of the motion task. Writer and reader: the motion task.
    TASK PERS tooldata ROS_own_tool := [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata ROS_own_wobj := [FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

    ! Initialise the settings of a program, so that the robot follows the checked path or does not move.
    PROC ROS_prepare_program()
        ConfJ \On;
        set_path_mode 0;
        check_displacement;
    ENDPROC

    ! A displacement is detected by applying it to the zero pose.
    LOCAL PROC check_displacement()
        VAR robtarget displacement := [[0,0,0],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]];

        displacement := ORobT(displacement);
        is_displaced := VectMagn(displacement.trans) > DISPLACEMENT_TOL OR displacement.extax <> ZERO_EXTAX
            OR Abs(displacement.rot.q2) + Abs(displacement.rot.q3) + Abs(displacement.rot.q4) > DISPLACEMENT_TOL / 1000;
    ENDPROC

    ! Restore the default path mode after a program that has changed it.
    PROC ROS_reset_path_mode()
        IF path_mode <> 0 set_path_mode 0;
    ENDPROC

    ! Set the path mode for linear moves. Bit 1: the wrist may turn freely (SingArea \Wrist). Bit 2: any
    ! configuration is allowed (ConfL \Off).
    LOCAL PROC set_path_mode(num bits)
        path_mode := bits;
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

    ! Fetch the instruction at a place of the ring buffer.
    PROC ROS_fetch_instr(num place)
        ROS_current_instr := ROS_instr_ring{place};
    ENDPROC

    ! Return TRUE if the robot stops at the end of the present instruction. `next` is the count of the
    ! following one. The robot stops if there is none yet, if one of the two does not move, and before a
    ! change of tool or work object.
    FUNC bool ROS_instr_stops(num next)
        VAR num place;

        IF ROS_current_instr.kind > ROS_DO_MOVE_C OR ROS_current_instr.zone.finep OR next = ROS_head RETURN TRUE;
        place := next MOD ROS_RING_SIZE + 1;
        IF ROS_instr_ring{place}.kind > ROS_DO_MOVE_C RETURN TRUE;
        RETURN ROS_instr_ring{place}.tool <> ROS_current_instr.tool
            OR ROS_instr_ring{place}.wobj <> ROS_current_instr.wobj;
    ENDFUNC

    ! Change the present move into its remainder: a stop at its target, without its signals.
    PROC ROS_end_at_target()
        IF ROS_current_instr.kind = ROS_DO_MOVE_C ROS_current_instr.kind := ROS_DO_MOVE_L;
        ROS_current_instr.trigg_events := 0;
    ENDPROC

    PROC ROS_execute(bool stops, num percent)
        ROS_instr_fault := ROS_REASON_NONE;
        TEST ROS_current_instr.kind
        CASE ROS_DO_SETTINGS:
            set_path_mode ROS_current_instr.value;
            RETURN;
        CASE ROS_DO_TOOL:
            ! The robot stands, so no move uses the old values.
            ROS_own_tool := [TRUE,[ROS_current_instr.target.trans,ROS_current_instr.target.rot],ROS_current_instr.load];
            RETURN;
        CASE ROS_DO_WORK_OBJECT:
            ROS_own_wobj := [FALSE,TRUE,"",[ROS_current_instr.target.trans,ROS_current_instr.target.rot],
                [ROS_current_instr.via.trans,ROS_current_instr.via.rot]];
            RETURN;
        CASE ROS_DO_WAIT:
            WaitTime ROS_current_instr.seconds;
            RETURN;
        ENDTEST
        IF is_displaced AND ROS_current_instr.kind <> ROS_DO_MOVE_ABSJ THEN
            ROS_instr_fault := ROS_REASON_POSE_MISMATCH;
            ErrWrite "ROS: poses are displaced", "A program displacement or offset is in force."
                \RL2:="Poses were checked without it." \RL3:="PDispOff, EOffsOff";
            RETURN;
        ENDIF
        zone := ROS_current_instr.zone;
        IF stops zone := fine;
        speed := ROS_current_instr.speed;
        speed.v_tcp := speed.v_tcp * percent / 100;
        speed.v_ori := speed.v_ori * percent / 100;
        speed.v_leax := speed.v_leax * percent / 100;
        speed.v_reax := speed.v_reax * percent / 100;
        TEST ROS_current_instr.tool
        CASE 0:
            move_with_tool torch;
        CASE 1:
            move_with_tool ROS_own_tool;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC move_with_tool(PERS tooldata tool)
        TEST ROS_current_instr.wobj
        CASE 0:
            move tool, table;
        CASE 1:
            move tool, ROS_own_wobj;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC move(PERS tooldata tool, PERS wobjdata wobj)
        TEST ROS_current_instr.kind
        CASE ROS_DO_MOVE_ABSJ:
            MoveAbsJ ROS_current_instr.joints \NoEOffs, speed, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_J:
            MoveJ ROS_current_instr.target, speed, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_L:
            MoveL ROS_current_instr.target, speed, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_C:
            MoveC ROS_current_instr.via, ROS_current_instr.target, speed, zone, tool \WObj:=wobj;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
