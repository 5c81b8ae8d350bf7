MODULE ROS_execution
    ! Programs: execution of their instructions.
    !
    ! Robot "two_arms_track-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! This module belongs to the motion task. All checks were made before an instruction was put into
    ! the ring buffer. ROS_motion takes it out, and leaves it by a long jump if the robot was stopped.

    CONST string ROS_BUILD_EXECUTION := "5273285319d5";

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
    ! Signals of the present instruction, and triggers for four moves, because earlier moves may not be
    ! finished.
    LOCAL VAR ROS_trigg_event trigg_event{8};
    LOCAL VAR triggdata trigger{4, 8};
    LOCAL VAR num trigger_set := 0;

    ! As in ROS_control, these signals are connected to their names, here at the start of a program.
    LOCAL CONST string NAME_1 := "clamp_close";
    LOCAL VAR signaldo signal_1;
    LOCAL VAR bool has_1 := FALSE;
    LOCAL CONST string NAME_2 := "part_present";
    LOCAL VAR signaldi signal_2;
    LOCAL VAR bool has_2 := FALSE;
    LOCAL VAR bool link_ok := FALSE;

    ! Initialise the settings of a program, so that the robot follows the checked path or does not move.
    PROC ROS_prepare_program()
        ConfJ \On;
        set_path_mode 0;
        check_displacement;
        link_signals;
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
        ROS_current_instr := ROS_instr_ring_1{place};
        FOR n FROM 1 TO ROS_MAX_TRIGG_EVENTS DO
            IF n <= ROS_current_instr.trigg_events trigg_event{n} := ROS_trigg_events_1{place, n};
        ENDFOR
    ENDPROC

    ! Return TRUE if the robot stops at the end of the present instruction. `next` is the count of the
    ! following one. The robot stops if there is none yet, if one of the two does not move, and before a
    ! change of tool or work object.
    FUNC bool ROS_instr_stops(num next)
        VAR num place;

        IF ROS_current_instr.kind > ROS_DO_MOVE_C OR ROS_current_instr.zone.finep OR next = ROS_head_1 RETURN TRUE;
        place := next MOD ROS_RING_SIZE + 1;
        IF ROS_instr_ring_1{place}.kind > ROS_DO_MOVE_C RETURN TRUE;
        RETURN ROS_instr_ring_1{place}.tool <> ROS_current_instr.tool
            OR ROS_instr_ring_1{place}.wobj <> ROS_current_instr.wobj;
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
        CASE ROS_DO_WAIT_SIGNAL:
            wait_for_signal;
            RETURN;
        CASE ROS_DO_SET:
            set_signal;
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
        IF ROS_current_instr.trigg_events > 0 set_triggers;
        IF ROS_instr_fault <> ROS_REASON_NONE RETURN;
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
            move tool, wobj0;
        CASE 1:
            move tool, ROS_own_wobj;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC move(PERS tooldata tool, PERS wobjdata wobj)
        IF ROS_current_instr.trigg_events > 0 THEN
            move_with_signals tool, wobj;
            RETURN;
        ENDIF
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

    ! Move with signals on the path. Always use all eight triggers; surplus ones repeat the last one.
    LOCAL PROC move_with_signals(PERS tooldata tool, PERS wobjdata wobj)
        TEST ROS_current_instr.kind
        CASE ROS_DO_MOVE_J:
            TriggJ ROS_current_instr.target, speed, trigger{trigger_set, 1}
                \T2:=trigger{trigger_set, 2} \T3:=trigger{trigger_set, 3} \T4:=trigger{trigger_set, 4}
                \T5:=trigger{trigger_set, 5} \T6:=trigger{trigger_set, 6}
                \T7:=trigger{trigger_set, 7} \T8:=trigger{trigger_set, 8}, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_L:
            TriggL ROS_current_instr.target, speed, trigger{trigger_set, 1}
                \T2:=trigger{trigger_set, 2} \T3:=trigger{trigger_set, 3} \T4:=trigger{trigger_set, 4}
                \T5:=trigger{trigger_set, 5} \T6:=trigger{trigger_set, 6}
                \T7:=trigger{trigger_set, 7} \T8:=trigger{trigger_set, 8}, zone, tool \WObj:=wobj;
        CASE ROS_DO_MOVE_C:
            TriggC ROS_current_instr.via, ROS_current_instr.target, speed, trigger{trigger_set, 1}
                \T2:=trigger{trigger_set, 2} \T3:=trigger{trigger_set, 3} \T4:=trigger{trigger_set, 4}
                \T5:=trigger{trigger_set, 5} \T6:=trigger{trigger_set, 6}
                \T7:=trigger{trigger_set, 7} \T8:=trigger{trigger_set, 8}, zone, tool \WObj:=wobj;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC set_triggers()
        VAR num source;

        trigger_set := trigger_set MOD 4 + 1;
        FOR n FROM 1 TO ROS_MAX_TRIGG_EVENTS DO
            source := n;
            IF n > ROS_current_instr.trigg_events source := ROS_current_instr.trigg_events;
            set_trigger n, trigg_event{source};
        ENDFOR
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC set_trigger(num n, ROS_trigg_event entry)
        TEST entry.signal
        CASE 0:
            IF NOT has_1 THEN
                ROS_instr_fault := ROS_REASON_NO_SIGNAL;
            ELSEIF entry.kind = ROS_TRIGG_START THEN
                TriggIO trigger{trigger_set, n}, entry.place \Start \DOp:=signal_1, entry.value;
            ELSEIF entry.kind = ROS_TRIGG_END THEN
                TriggIO trigger{trigger_set, n}, entry.place \DOp:=signal_1, entry.value;
            ELSE
                TriggIO trigger{trigger_set, n}, entry.place \Time \DOp:=signal_1, entry.value;
            ENDIF
        ENDTEST
    ERROR
        ! Its I/O unit does not exist or the value is too large for it.
        SkipWarn;
        ROS_instr_fault := ROS_REASON_BAD_VALUE;
        RETURN;
    ENDPROC

    LOCAL PROC set_signal()
        TEST ROS_current_instr.signal
        CASE 0:
            IF NOT has_1 THEN
                ROS_instr_fault := ROS_REASON_NO_SIGNAL;
            ELSE
                SetDO signal_1, ROS_current_instr.value;
            ENDIF
        ENDTEST
    ERROR
        SkipWarn;
        ROS_instr_fault := ROS_REASON_BAD_VALUE;
        RETURN;
    ENDPROC

    ! Wait for a signal. A time-out ends the program.
    LOCAL PROC wait_for_signal()
        TEST ROS_current_instr.signal
        CASE 0:
            IF NOT has_1 THEN
                ROS_instr_fault := ROS_REASON_NO_SIGNAL;
            ELSE
                WaitDO signal_1, ROS_current_instr.value \MaxTime:=ROS_current_instr.seconds;
            ENDIF
        CASE 1:
            IF NOT has_2 THEN
                ROS_instr_fault := ROS_REASON_NO_SIGNAL;
            ELSE
                WaitDI signal_2, ROS_current_instr.value \MaxTime:=ROS_current_instr.seconds;
            ENDIF
        ENDTEST
    ERROR
        SkipWarn;
        ROS_instr_fault := ROS_REASON_NO_SIGNAL;
        IF ERRNO = ERR_WAIT_MAXTIME ROS_instr_fault := ROS_REASON_WAITED;
        RETURN;
    ENDPROC

    LOCAL PROC link_signals()
        link_ok := TRUE;
        AliasIO NAME_1, signal_1;
        has_1 := link_ok;
        link_ok := TRUE;
        AliasIO NAME_2, signal_2;
        has_2 := link_ok;
    ERROR
        ! The controller has no such signal.
        SkipWarn;
        link_ok := FALSE;
        TRYNEXT;
    ENDPROC
ENDMODULE
