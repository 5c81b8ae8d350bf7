MODULE ROS_execution
    ! Programs: their instructions, executed one after the other.
    !
    ! Robot "two_arms_track-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! In the motion task. All was checked before it came into the ring; ROS_motion takes it out there, and
    ! leaves an instruction that is under way when the robot was stopped.

    CONST string ROS_BUILD_EXECUTION := "783ab54af970";

    ! The instruction at hand.
    VAR ROS_order ROS_ordered;

    ! What holds at the beginning of each program: the path is the one that was checked, or none.
    PROC ROS_prepare_program()
        ConfJ \On;
        ConfL \On;
        SingArea \Off;
    ENDPROC

    ! TRUE if the robot stops at the end of the instruction at hand; `next` is the place of the one behind
    ! it. Without one it does.
    FUNC bool ROS_order_stops(num next)
        RETURN ROS_ordered.zone.finep OR next = ROS_head_1;
    ENDFUNC

    PROC ROS_execute(bool stops)
        VAR zonedata zone;

        zone := ROS_ordered.zone;
        IF stops zone := fine;
        TEST ROS_ordered.kind
        CASE ROS_DO_MOVE_ABSJ:
            MoveAbsJ ROS_ordered.joints \NoEOffs, ROS_ordered.speed, zone, torch \WObj:=wobj0;
        CASE ROS_DO_MOVE_J:
            MoveJ ROS_ordered.target, ROS_ordered.speed, zone, torch \WObj:=wobj0;
        CASE ROS_DO_MOVE_L:
            MoveL ROS_ordered.target, ROS_ordered.speed, zone, torch \WObj:=wobj0;
        CASE ROS_DO_MOVE_C:
            MoveC ROS_ordered.via, ROS_ordered.target, ROS_ordered.speed, zone, torch \WObj:=wobj0;
        ENDTEST
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
