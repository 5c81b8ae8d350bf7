MODULE ROS_programs
    ! Programs: instructions as they come, and what is checked of them.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! Batches of them come as batches of points do (ROS_stream). An instruction that moves brings the
    ! joints at its end, also one to a pose: what these reach is asked of the controller, and has to be that
    ! pose. So the limits are those of the joints, the configuration is the one that the controller
    ! gives, and a client whose robot is another one is refused before anything moves.

    CONST string ROS_BUILD_PROGRAMS := "88e807c4be29";

    ! mm/s and deg/s of a speed, mm and deg of a zone, at most.
    LOCAL CONST num TCP_SPEED := 5000;
    LOCAL CONST num FASTEST := 10000;
    LOCAL CONST num WIDEST := 1000;
    ! Numbers of the wire are steps: so many to 1, and what one is.
    LOCAL CONST dnum STEPS := 1000000;
    LOCAL CONST dnum DEG := 5.729577951308232E-05;
    LOCAL CONST dnum MM := 0.001;
    ! s of a wait, at most.
    LOCAL CONST num LONGEST := 2000;
    ! A pose is reached when it is no farther away than this (mm), and no more turned than this cosine of
    ! half an angle: 0.2 degrees for each mm.
    LOCAL CONST num NEAR := 1;
    LOCAL CONST num UNTURNED := 0.999998;
    ! mm between two of the three points of a circle, at least, and the sine of 1 degree, by which the
    ! first one sees the others apart, at least: limits of MoveC.
    LOCAL CONST num APART := 0.1;
    LOCAL CONST num ASIDE := 0.017452;
    ! mm, kg and kg m2 of a tool or work object whose values the client sends, at most.
    LOCAL CONST num FARTHEST := 100000;
    LOCAL CONST num HEAVIEST := 2000;
    LOCAL CONST num MOST_INERTIA := 2000;
    TASK PERS tooldata ROS_own_tool := [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata ROS_own_wobj := [FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

    ! The instruction at hand, and what of it was ever given.
    LOCAL VAR ROS_order order;
    LOCAL VAR ROS_mark mark{8};
    LOCAL VAR bool has_speed := FALSE;
    LOCAL VAR bool has_zone := FALSE;
    LOCAL VAR bool has_own_tool := FALSE;
    LOCAL VAR bool has_own_wobj := FALSE;
    ! Where the robot has to stand when the program begins.
    LOCAL VAR jointtarget start;
    ! Where the move before ends: its joints, and its pose if it has one in the frames that are in use.
    LOCAL VAR jointtarget here;
    LOCAL VAR robtarget before;
    LOCAL VAR bool at_pose := FALSE;
    ! Of the batch at hand: the byte that is read next, the one behind its words, its checksum, and the
    ! word that was read last.
    LOCAL VAR num at := 0;
    LOCAL VAR num behind := 0;
    LOCAL VAR dnum sum := 0;
    LOCAL VAR dnum word := 0;

    PROC ROS_begin_program()
        has_speed := FALSE;
        has_zone := FALSE;
        has_own_tool := FALSE;
        has_own_wobj := FALSE;
        order.tool := 0;
        order.wobj := 0;
    ENDPROC

    ! Take `count` instructions, which fill `data` from byte `first` up to byte `last`. Those before one
    ! that is wrong are written into the ring at `written`; `check` goes on over all words.
    PROC ROS_take_instructions(VAR rawbytes data, num first, num last, num count, INOUT dnum check,
        INOUT num written)
        at := first;
        behind := last;
        sum := check;
        IF ROS_count = 0 AND at < behind THEN
            take_joints data;
            start := order.joints;
            here := start;
            at_pose := FALSE;
            ROS_object ROS_start_fault();
        ENDIF
        WHILE count > 0 AND ROS_fault = ROS_REASON_NONE DO
            count := count - 1;
            take_instruction data;
            IF ROS_fault = ROS_REASON_NONE THEN
                put written;
                written := ROS_next(written);
            ENDIF
        ENDWHILE
        IF at < behind ROS_object ROS_REASON_FRAMING;
        WHILE at < behind DO
            next_word data;
        ENDWHILE
        check := sum;
    ERROR
        RAISE;
    ENDPROC

    ! Why the program may not begin where the robot stands, 0: it may.
    FUNC num ROS_start_fault()
        VAR num needed;
        VAR num joint := 0;

        ROS_reach_start CJointT(), start, needed, joint;
        IF joint > 0 RETURN 100 * joint + ROS_REASON_START_TOO_FAR;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    LOCAL PROC put(num place)
        ROS_count := ROS_count + 1;
        IF ROS_count = ROS_INDEX_WRAP ROS_count := 0;
        order.session := ROS_trajectory_2;
        order.index := ROS_count;
        ROS_orders_2{place MOD ROS_RING_SIZE + 1} := order;
        FOR n FROM 1 TO 8 DO
            IF n <= order.marks ROS_marks_2{place MOD ROS_RING_SIZE + 1, n} := mark{n};
        ENDFOR
    ENDPROC

    ! -- reading -------------------------------------------------------------------------------------

    ! The next word, which enters the checksum.
    LOCAL PROC next_word(VAR rawbytes data)
        IF at >= behind THEN
            ROS_object ROS_REASON_FRAMING;
            word := 0;
            RETURN;
        ENDIF
        UnpackRawBytes data, at, word \IntX:=DINT;
        at := at + 4;
        sum := (2 * sum + word + ROS_CHECKSUM_OFFSET) MOD ROS_CHECKSUM_MODULUS;
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC num plain(VAR rawbytes data)
        next_word data;
        RETURN DnumToNum(word / STEPS);
    ERROR
        RAISE;
    ENDFUNC

    LOCAL FUNC num in_mm(VAR rawbytes data)
        next_word data;
        RETURN DnumToNum(word * MM);
    ERROR
        RAISE;
    ENDFUNC

    LOCAL FUNC num in_deg(VAR rawbytes data)
        next_word data;
        RETURN DnumToNum(word * DEG);
    ERROR
        RAISE;
    ENDFUNC

    LOCAL PROC take_instruction(VAR rawbytes data)
        VAR num first;

        next_word data;
        first := DnumToNum(word);
        IF NOT (0 < first AND first < 2 * ROS_SET_SIGNALS) THEN
            ROS_object ROS_REASON_NO_INSTRUCTION;
            RETURN;
        ENDIF
        IF (first DIV ROS_SET_SPEED) MOD 2 = 1 take_speed data;
        IF (first DIV ROS_SET_ZONE) MOD 2 = 1 take_zone data;
        IF (first DIV ROS_SET_FRAMES) MOD 2 = 1 take_frames data;
        order.kind := first MOD ROS_SET_SPEED;
        order.marks := 0;
        IF (first DIV ROS_SET_SIGNALS) MOD 2 = 1 take_marks data;
        TEST order.kind
        CASE ROS_DO_MOVE_ABSJ:
            take_joints data;
            ! Signals are set on the way to a pose: to the one that these joints have.
            IF order.marks > 0 meet_joints;
        CASE ROS_DO_SETTINGS:
            order.value := plain(data);
            IF NOT (0 <= order.value AND order.value <= 3 AND order.value = Trunc(order.value))
                ROS_object ROS_REASON_BAD_VALUE;
        CASE ROS_DO_TOOL:
            take_tool data;
        CASE ROS_DO_WORK_OBJECT:
            take_wobj data;
        CASE ROS_DO_MOVE_J, ROS_DO_MOVE_L:
            take_pose data, order.target;
            take_joints data;
            meet_pose;
        CASE ROS_DO_MOVE_C:
            take_pose data, order.via;
            take_pose data, order.target;
            take_joints data;
            meet_pose;
            meet_circle;
            order.via.robconf := order.target.robconf;
            order.via.extax := order.target.extax;
        CASE ROS_DO_WAIT:
            order.seconds := plain(data);
            IF NOT (0 <= order.seconds AND order.seconds <= LONGEST) ROS_object ROS_REASON_BAD_VALUE;
        CASE ROS_DO_WAIT_SIGNAL:
            order.signal := plain(data);
            order.value := plain(data);
            order.seconds := plain(data);
            IF NOT (0 <= order.seconds AND order.seconds <= LONGEST) ROS_object ROS_REASON_BAD_VALUE;
            ROS_object wait_fault(order.signal, order.value);
        CASE ROS_DO_SET:
            order.signal := plain(data);
            order.value := plain(data);
            ROS_object set_fault(order.signal, order.value);
        DEFAULT:
            ROS_object ROS_REASON_NO_INSTRUCTION;
            RETURN;
        ENDTEST
        ! A signal on the way needs a way of the TCP.
        IF order.marks > 0 AND (order.kind < ROS_DO_MOVE_J OR order.kind > ROS_DO_MOVE_C)
            ROS_object ROS_REASON_NO_INSTRUCTION;
        IF order.kind > ROS_DO_MOVE_C RETURN;
        IF NOT has_speed ROS_object ROS_REASON_BAD_SPEED;
        IF NOT has_zone ROS_object ROS_REASON_BAD_ZONE;
        here := order.joints;
        at_pose := order.kind > ROS_DO_MOVE_ABSJ;
        IF at_pose before := order.target;
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC take_speed(VAR rawbytes data)
        order.speed.v_tcp := in_mm(data);
        order.speed.v_ori := in_deg(data);
        order.speed.v_leax := in_mm(data);
        order.speed.v_reax := in_deg(data);
        has_speed := is_speed(order.speed.v_tcp, TCP_SPEED) AND is_speed(order.speed.v_ori, FASTEST)
            AND is_speed(order.speed.v_leax, FASTEST) AND is_speed(order.speed.v_reax, FASTEST);
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool is_speed(num value, num most)
        RETURN 0 < value AND value <= most;
    ENDFUNC

    LOCAL PROC take_zone(VAR rawbytes data)
        VAR num stops;

        stops := plain(data);
        order.zone.finep := (stops = 1);
        order.zone.pzone_tcp := in_mm(data);
        order.zone.pzone_ori := in_mm(data);
        order.zone.pzone_eax := in_mm(data);
        order.zone.zone_ori := in_deg(data);
        order.zone.zone_leax := in_mm(data);
        order.zone.zone_reax := in_deg(data);
        has_zone := (stops = 0 OR stops = 1) AND is_radius(order.zone.pzone_tcp)
            AND is_radius(order.zone.pzone_ori) AND is_radius(order.zone.pzone_eax) AND is_radius(order.zone.zone_ori)
            AND is_radius(order.zone.zone_leax) AND is_radius(order.zone.zone_reax);
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool is_radius(num value)
        RETURN 0 <= value AND value <= WIDEST;
    ENDFUNC

    LOCAL PROC take_frames(VAR rawbytes data)
        order.tool := plain(data);
        order.wobj := plain(data);
        IF NOT (0 <= order.tool AND order.tool < 2 AND order.tool = Trunc(order.tool)
            AND 0 <= order.wobj AND order.wobj < 2 AND order.wobj = Trunc(order.wobj))
            ROS_object ROS_REASON_NO_FRAME;
        at_pose := FALSE;
        IF (order.tool = 1 AND (NOT has_own_tool)) OR (order.wobj = 1 AND (NOT has_own_wobj))
            ROS_object ROS_REASON_NO_FRAME;
    ERROR
        RAISE;
    ENDPROC

    ! The values of a tool: poses behind this are its own, here as in the motion task.
    LOCAL PROC take_tool(VAR rawbytes data)
        take_frame data, order.target;
        ! Where it is heavy, and how the axes of inertia lie.
        take_frame data, order.via;
        order.load.cog := order.via.trans;
        order.load.aom := order.via.rot;
        order.load.mass := plain(data);
        order.load.ix := plain(data);
        order.load.iy := plain(data);
        order.load.iz := plain(data);
        IF NOT (0 < order.load.mass AND order.load.mass <= HEAVIEST AND is_inertia(order.load.ix)
            AND is_inertia(order.load.iy) AND is_inertia(order.load.iz)) ROS_object ROS_REASON_BAD_VALUE;
        IF ROS_fault <> ROS_REASON_NONE RETURN;
        ROS_own_tool := [TRUE,[order.target.trans,order.target.rot],order.load];
        has_own_tool := TRUE;
        at_pose := FALSE;
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool is_inertia(num value)
        RETURN 0 <= value AND value <= MOST_INERTIA;
    ENDFUNC

    ! The same of a work object: its user frame and its object frame.
    LOCAL PROC take_wobj(VAR rawbytes data)
        take_frame data, order.target;
        take_frame data, order.via;
        IF ROS_fault <> ROS_REASON_NONE RETURN;
        ROS_own_wobj := [FALSE,TRUE,"",[order.target.trans,order.target.rot],[order.via.trans,order.via.rot]];
        has_own_wobj := TRUE;
        at_pose := FALSE;
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC take_frame(VAR rawbytes data, INOUT robtarget target)
        take_pose data, target;
        IF NOT (VectMagn(target.trans) <= FARTHEST) ROS_object ROS_REASON_BAD_VALUE;
    ERROR
        RAISE;
    ENDPROC

    ! Signals that are set on the way.
    LOCAL PROC take_marks(VAR rawbytes data)
        VAR num count;

        count := plain(data);
        IF NOT (1 <= count AND count <= 8) THEN
            ROS_object ROS_REASON_BAD_VALUE;
            RETURN;
        ENDIF
        FOR n FROM 1 TO count DO
            mark{n}.signal := plain(data);
            mark{n}.value := plain(data);
            mark{n}.kind := plain(data);
            ! m to mm; s stay s.
            mark{n}.place := plain(data);
            IF mark{n}.kind <> ROS_MARK_TIME mark{n}.place := 1000 * mark{n}.place;
            ROS_object set_fault(mark{n}.signal, mark{n}.value);
            IF NOT (0 <= mark{n}.place AND mark{n}.place <= 10000) ROS_object ROS_REASON_BAD_VALUE;
            IF mark{n}.kind <> ROS_MARK_START AND mark{n}.kind <> ROS_MARK_END AND mark{n}.kind <> ROS_MARK_TIME
                ROS_object ROS_REASON_BAD_VALUE;
        ENDFOR
        order.marks := count;
    ERROR
        RAISE;
    ENDPROC

    ! Why a signal cannot be set to a value, 0: it can.
    LOCAL FUNC num set_fault(num signal, num value)
        TEST signal
        CASE 0:
            IF value <> 0 AND value <> 1 RETURN ROS_REASON_BAD_VALUE;
        CASE 1:
            RETURN ROS_REASON_READ_ONLY;
        DEFAULT:
            RETURN ROS_REASON_NO_SIGNAL;
        ENDTEST
        RETURN ROS_REASON_NONE;
    ENDFUNC

    ! Why nobody can wait for a value of a signal, 0: one can.
    LOCAL FUNC num wait_fault(num signal, num value)
        TEST signal
        CASE 0:
            IF value <> 0 AND value <> 1 RETURN ROS_REASON_BAD_VALUE;
        CASE 1:
            IF value <> 0 AND value <> 1 RETURN ROS_REASON_BAD_VALUE;
        DEFAULT:
            RETURN ROS_REASON_NO_SIGNAL;
        ENDTEST
        RETURN ROS_REASON_NONE;
    ENDFUNC

    ! The joints at the end, within their limits.
    LOCAL PROC take_joints(VAR rawbytes data)
        VAR num joint_1;
        VAR num joint_2;
        VAR num joint_3;
        VAR num joint_4;
        VAR num joint_5;
        VAR num joint_6;

        next_word data;
        joint_1 := DnumToNum(word * DEG);
        IF NOT (ROS_low{1} <= joint_1 AND joint_1 <= ROS_high{1})
            joint_1 := ROS_judged(joint_1, 0, 1);
        next_word data;
        joint_2 := DnumToNum(word * DEG);
        IF NOT (ROS_low{2} <= joint_2 AND joint_2 <= ROS_high{2})
            joint_2 := ROS_judged(joint_2, 0, 2);
        next_word data;
        joint_3 := DnumToNum(word * DEG);
        IF NOT (ROS_low{3} <= joint_3 AND joint_3 <= ROS_high{3})
            joint_3 := ROS_judged(joint_3, 0, 3);
        next_word data;
        joint_4 := DnumToNum(word * DEG);
        IF NOT (ROS_low{4} <= joint_4 AND joint_4 <= ROS_high{4})
            joint_4 := ROS_judged(joint_4, 0, 4);
        next_word data;
        joint_5 := DnumToNum(word * DEG);
        IF NOT (ROS_low{5} <= joint_5 AND joint_5 <= ROS_high{5})
            joint_5 := ROS_judged(joint_5, 0, 5);
        next_word data;
        joint_6 := DnumToNum(word * DEG);
        IF NOT (ROS_low{6} <= joint_6 AND joint_6 <= ROS_high{6})
            joint_6 := ROS_judged(joint_6, 0, 6);
        order.joints := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],[9E9,9E9,9E9,9E9,9E9,9E9]];
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC take_pose(VAR rawbytes data, INOUT robtarget target)
        VAR num size;

        next_word data;
        target.trans.x := DnumToNum(word * MM);
        next_word data;
        target.trans.y := DnumToNum(word * MM);
        next_word data;
        target.trans.z := DnumToNum(word * MM);
        next_word data;
        target.rot.q1 := DnumToNum(word / STEPS);
        next_word data;
        target.rot.q2 := DnumToNum(word / STEPS);
        next_word data;
        target.rot.q3 := DnumToNum(word / STEPS);
        next_word data;
        target.rot.q4 := DnumToNum(word / STEPS);
        size := along(target.rot, target.rot);
        IF 0.99 < size AND size < 1.01 THEN
            target.rot := NOrient(target.rot);
        ELSE
            ROS_object ROS_REASON_BAD_VALUE;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC num along(orient a, orient b)
        RETURN a.q1 * b.q1 + a.q2 * b.q2 + a.q3 * b.q3 + a.q4 * b.q4;
    ENDFUNC

    LOCAL FUNC robtarget pose_with(PERS tooldata tool, jointtarget joints)
        TEST order.wobj
        CASE 1:
            RETURN CalcRobT(joints, tool \WObj:=ROS_own_wobj);
        DEFAULT:
            RETURN CalcRobT(joints, tool \WObj:=wobj0);
        ENDTEST
    ERROR
        RAISE;
    ENDFUNC

    ! The pose that the joints reach.
    LOCAL FUNC robtarget pose_of(jointtarget joints)
        TEST order.tool
        CASE 1:
            RETURN pose_with(ROS_own_tool, joints);
        DEFAULT:
            RETURN pose_with(tool0, joints);
        ENDTEST
    ERROR
        RAISE;
    ENDFUNC

    ! The joints have to reach the pose; then the target has the configuration that they have, and
    ! their external axes.
    LOCAL PROC meet_pose()
        VAR robtarget reached;

        IF ROS_fault <> ROS_REASON_NONE RETURN;
        reached := pose_of(order.joints);
        IF NOT (VectMagn(reached.trans - order.target.trans) <= NEAR
            AND Abs(along(reached.rot, order.target.rot)) >= UNTURNED)
            ROS_object ROS_REASON_POSE_MISMATCH;
        order.target.robconf := reached.robconf;
        order.target.extax := reached.extax;
    ERROR
        SkipWarn;
        ROS_object ROS_REASON_NO_GEOMETRY;
        RETURN;
    ENDPROC

    ! A circle begins where the move before ends, and turns 240 degrees at most: then its ends are seen
    ! from its point on the way 60 degrees apart and more.
    LOCAL PROC meet_circle()
        VAR pos back;
        VAR pos on;
        VAR pos across;

        IF ROS_fault <> ROS_REASON_NONE RETURN;
        IF NOT at_pose before := pose_of(here);
        back := before.trans - order.via.trans;
        on := order.target.trans - order.via.trans;
        across := order.target.trans - before.trans;
        IF VectMagn(back) < APART OR VectMagn(on) < APART
            OR VectMagn(back * across) < ASIDE * VectMagn(back) * VectMagn(across)
            OR DotProd(back, on) > 0.5 * VectMagn(back) * VectMagn(on)
            ROS_object ROS_REASON_NO_CIRCLE;
    ERROR
        SkipWarn;
        ROS_object ROS_REASON_NO_GEOMETRY;
        RETURN;
    ENDPROC

    LOCAL PROC meet_joints()
        IF ROS_fault <> ROS_REASON_NONE RETURN;
        order.target := pose_of(order.joints);
        order.kind := ROS_DO_MOVE_J;
    ERROR
        SkipWarn;
        ROS_object ROS_REASON_NO_GEOMETRY;
        RETURN;
    ENDPROC
ENDMODULE
