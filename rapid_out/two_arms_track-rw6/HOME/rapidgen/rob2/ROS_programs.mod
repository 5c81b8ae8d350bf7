MODULE ROS_programs
    ! Programs: reading and checking of their instructions.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! The batches of a program have the same form as batches of points (ROS_stream). Each instruction
    ! that moves contains the joints at its end, also if its target is a pose: CalcRobT of these joints
    ! must give that pose. So the limits of the joints can be checked, the configuration (robconf) is
    ! the controller's own, and a client with a wrong robot model is rejected before anything moves.

    CONST string ROS_BUILD_PROGRAMS := "5273285319d5";

    ! Upper limits: speeds in mm/s and deg/s, sizes of a zone in mm and deg.
    LOCAL CONST num MAX_TCP_SPEED := 5000;
    LOCAL CONST num MAX_SPEED := 10000;
    LOCAL CONST num MAX_ZONE_SIZE := 1000;
    ! Values on the wire are integer steps: steps per unit, and size of one step.
    LOCAL CONST dnum STEPS_PER_UNIT := 1000000;
    LOCAL CONST dnum DEG_PER_STEP := 5.729577951308232E-05;
    LOCAL CONST dnum MM_PER_STEP := 0.001;
    ! Longest wait and longest routine call, s.
    LOCAL CONST num MAX_WAIT := 2000;
    ! Largest distance (mm) or time (s) of a signal from the end of the path at which it is set.
    LOCAL CONST num MAX_TRIGG_PLACE := 10000;
    ! The joints reach a pose if its position differs by no more than this (mm), and the cosine of half
    ! the angle between the orientations is not below this (0.2 degrees for each mm).
    LOCAL CONST num POSE_TOL_MM := 1;
    LOCAL CONST num POSE_TOL_COS := 0.999998;
    ! Limits of MoveC: smallest distance between two of the three points (mm), and sine of 1 degree, the
    ! smallest angle between the other two points as seen from the first one.
    LOCAL CONST num MIN_CIRCLE_MM := 0.1;
    LOCAL CONST num MIN_CIRCLE_SINE := 0.017452;
    ! Upper limits for a tool or work object that the client defines: mm, kg and kg m2.
    LOCAL CONST num MAX_FRAME_MM := 100000;
    LOCAL CONST num MAX_MASS := 2000;
    LOCAL CONST num MAX_INERTIA := 2000;
    ! Tools and work objects of the configuration; ROS_own_tool and ROS_own_wobj hold those that the client
    ! defines. They are copies of this task. Writer and reader: this task.
    TASK PERS tooldata ROS_own_tool := [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata ROS_own_wobj := [FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

    ! Present instruction, and which of its settings were given so far.
    LOCAL VAR ROS_instr instr;
    LOCAL VAR ROS_trigg_event trigg_event{8};
    LOCAL VAR bool has_speed := FALSE;
    LOCAL VAR bool has_zone := FALSE;
    LOCAL VAR bool has_own_tool := FALSE;
    LOCAL VAR bool has_own_wobj := FALSE;
    ! Position at which the robot must stand when the program starts.
    LOCAL VAR jointtarget start_joints;
    ! End of the previous move: its joints, and its pose if it has one in the present frames.
    LOCAL VAR jointtarget last_joints;
    LOCAL VAR robtarget last_pose;
    LOCAL VAR bool has_last_pose := FALSE;
    ! Present batch: next byte to read, first byte after its words, its checksum, and the last word
    ! read.
    LOCAL VAR num next_byte := 0;
    LOCAL VAR num end_byte := 0;
    LOCAL VAR dnum checksum := 0;
    LOCAL VAR dnum word := 0;

    PROC ROS_init_program()
        has_speed := FALSE;
        has_zone := FALSE;
        has_own_tool := FALSE;
        has_own_wobj := FALSE;
        instr.tool := 0;
        instr.wobj := 0;
    ENDPROC

    ! Read `count` instructions, which occupy `data` from `first_byte` to `last_byte`. Instructions
    ! before a wrong one are written into the ring buffer at `next_head`. `batch_checksum` includes all
    ! words.
    PROC ROS_read_instructions(VAR rawbytes data, num first_byte, num last_byte, num count, INOUT dnum batch_checksum,
        INOUT num next_head)
        next_byte := first_byte;
        end_byte := last_byte;
        checksum := batch_checksum;
        IF ROS_point_count = 0 AND next_byte < end_byte THEN
            read_joints data;
            start_joints := instr.joints;
            last_joints := start_joints;
            has_last_pose := FALSE;
            ROS_set_fault ROS_check_program_start();
        ENDIF
        WHILE count > 0 AND ROS_point_fault = ROS_REASON_NONE DO
            count := count - 1;
            read_instruction data;
            IF ROS_point_fault = ROS_REASON_NONE THEN
                write_instr next_head;
                next_head := ROS_next_count(next_head);
            ENDIF
        ENDWHILE
        IF next_byte < end_byte ROS_set_fault ROS_REASON_FRAMING;
        WHILE next_byte < end_byte DO
            read_word data;
        ENDWHILE
        batch_checksum := checksum;
    ERROR
        RAISE;
    ENDPROC

    ! Return 0 if the program may start where the robot stands, else the reason against it.
    FUNC num ROS_check_program_start()
        VAR num approach_time;
        VAR num joint := 0;

        ROS_check_start CJointT(), start_joints, approach_time, joint;
        IF joint > 0 RETURN 100 * joint + ROS_REASON_START_TOO_FAR;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    LOCAL PROC write_instr(num position)
        ROS_point_count := ROS_point_count + 1;
        IF ROS_point_count = ROS_INDEX_WRAP ROS_point_count := 0;
        instr.trajectory := ROS_trajectory_2;
        instr.index := ROS_point_count;
        ROS_instr_ring_2{position MOD ROS_RING_SIZE + 1} := instr;
        FOR n FROM 1 TO ROS_MAX_TRIGG_EVENTS DO
            IF n <= instr.trigg_events ROS_trigg_events_2{position MOD ROS_RING_SIZE + 1, n} := trigg_event{n};
        ENDFOR
    ENDPROC

    ! Reading of words and instructions.

    ! Read the next word and add it to the checksum.
    LOCAL PROC read_word(VAR rawbytes data)
        IF next_byte >= end_byte THEN
            ROS_set_fault ROS_REASON_FRAMING;
            word := 0;
            RETURN;
        ENDIF
        UnpackRawBytes data, next_byte, word \IntX:=DINT;
        next_byte := next_byte + 4;
        checksum := (2 * checksum + word + ROS_CHECKSUM_OFFSET) MOD ROS_CHECKSUM_MODULUS;
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC num read_value(VAR rawbytes data)
        read_word data;
        RETURN DnumToNum(word / STEPS_PER_UNIT);
    ERROR
        RAISE;
    ENDFUNC

    LOCAL FUNC num read_mm(VAR rawbytes data)
        read_word data;
        RETURN DnumToNum(word * MM_PER_STEP);
    ERROR
        RAISE;
    ENDFUNC

    LOCAL FUNC num read_deg(VAR rawbytes data)
        read_word data;
        RETURN DnumToNum(word * DEG_PER_STEP);
    ERROR
        RAISE;
    ENDFUNC

    LOCAL PROC read_instruction(VAR rawbytes data)
        VAR num header;

        read_word data;
        header := DnumToNum(word);
        IF NOT (0 < header AND header < 2 * ROS_SET_SIGNALS) THEN
            ROS_set_fault ROS_REASON_NO_INSTRUCTION;
            RETURN;
        ENDIF
        IF (header DIV ROS_SET_SPEED) MOD 2 = 1 read_speed data;
        IF (header DIV ROS_SET_ZONE) MOD 2 = 1 read_zone data;
        IF (header DIV ROS_SET_FRAMES) MOD 2 = 1 read_frame_numbers data;
        instr.kind := header MOD ROS_SET_SPEED;
        instr.trigg_events := 0;
        IF (header DIV ROS_SET_SIGNALS) MOD 2 = 1 read_trigg_events data;
        TEST instr.kind
        CASE ROS_DO_MOVE_ABSJ:
            read_joints data;
            ! Signals can be set only on the path to a pose: it is computed from these joints.
            IF instr.trigg_events > 0 resolve_joints;
        CASE ROS_DO_SETTINGS:
            instr.value := read_value(data);
            IF NOT (0 <= instr.value AND instr.value <= 3 AND instr.value = Trunc(instr.value))
                ROS_set_fault ROS_REASON_BAD_VALUE;
        CASE ROS_DO_TOOL:
            read_tool data;
        CASE ROS_DO_WORK_OBJECT:
            read_wobj data;
        CASE ROS_DO_MOVE_J, ROS_DO_MOVE_L:
            read_pose data, instr.target;
            read_joints data;
            resolve_pose;
        CASE ROS_DO_MOVE_C:
            read_pose data, instr.via;
            read_pose data, instr.target;
            read_joints data;
            resolve_pose;
            resolve_circle;
            instr.via.robconf := instr.target.robconf;
            instr.via.extax := instr.target.extax;
        CASE ROS_DO_WAIT:
            instr.seconds := read_value(data);
            IF NOT (0 <= instr.seconds AND instr.seconds <= MAX_WAIT) ROS_set_fault ROS_REASON_BAD_VALUE;
        CASE ROS_DO_WAIT_SIGNAL:
            instr.signal := read_value(data);
            instr.value := read_value(data);
            instr.seconds := read_value(data);
            IF NOT (0 <= instr.seconds AND instr.seconds <= MAX_WAIT) ROS_set_fault ROS_REASON_BAD_VALUE;
            ROS_set_fault check_wait_value(instr.signal, instr.value);
        CASE ROS_DO_SET:
            instr.signal := read_value(data);
            instr.value := read_value(data);
            ROS_set_fault check_signal_value(instr.signal, instr.value);
        DEFAULT:
            ROS_set_fault ROS_REASON_NO_INSTRUCTION;
            RETURN;
        ENDTEST
        ! A signal on the path needs a TCP path.
        IF instr.trigg_events > 0 AND (instr.kind < ROS_DO_MOVE_J OR instr.kind > ROS_DO_MOVE_C)
            ROS_set_fault ROS_REASON_NO_INSTRUCTION;
        IF instr.kind > ROS_DO_MOVE_C RETURN;
        IF NOT has_speed ROS_set_fault ROS_REASON_BAD_SPEED;
        IF NOT has_zone ROS_set_fault ROS_REASON_BAD_ZONE;
        last_joints := instr.joints;
        has_last_pose := instr.kind > ROS_DO_MOVE_ABSJ;
        IF has_last_pose last_pose := instr.target;
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC read_speed(VAR rawbytes data)
        instr.speed.v_tcp := read_mm(data);
        instr.speed.v_ori := read_deg(data);
        instr.speed.v_leax := read_mm(data);
        instr.speed.v_reax := read_deg(data);
        has_speed := is_valid_speed(instr.speed.v_tcp, MAX_TCP_SPEED) AND is_valid_speed(instr.speed.v_ori, MAX_SPEED)
            AND is_valid_speed(instr.speed.v_leax, MAX_SPEED) AND is_valid_speed(instr.speed.v_reax, MAX_SPEED);
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool is_valid_speed(num value, num maximum)
        RETURN 0 < value AND value <= maximum;
    ENDFUNC

    LOCAL PROC read_zone(VAR rawbytes data)
        VAR num stop_flag;

        stop_flag := read_value(data);
        instr.zone.finep := (stop_flag = 1);
        instr.zone.pzone_tcp := read_mm(data);
        instr.zone.pzone_ori := read_mm(data);
        instr.zone.pzone_eax := read_mm(data);
        instr.zone.zone_ori := read_deg(data);
        instr.zone.zone_leax := read_mm(data);
        instr.zone.zone_reax := read_deg(data);
        has_zone := (stop_flag = 0 OR stop_flag = 1) AND is_valid_size(instr.zone.pzone_tcp)
            AND is_valid_size(instr.zone.pzone_ori) AND is_valid_size(instr.zone.pzone_eax)
            AND is_valid_size(instr.zone.zone_ori) AND is_valid_size(instr.zone.zone_leax)
            AND is_valid_size(instr.zone.zone_reax);
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool is_valid_size(num value)
        RETURN 0 <= value AND value <= MAX_ZONE_SIZE;
    ENDFUNC

    LOCAL PROC read_frame_numbers(VAR rawbytes data)
        instr.tool := read_value(data);
        instr.wobj := read_value(data);
        IF NOT (0 <= instr.tool AND instr.tool < 2 AND instr.tool = Trunc(instr.tool)
            AND 0 <= instr.wobj AND instr.wobj < 2 AND instr.wobj = Trunc(instr.wobj))
            ROS_set_fault ROS_REASON_NO_FRAME;
        has_last_pose := FALSE;
        IF (instr.tool = 1 AND (NOT has_own_tool)) OR (instr.wobj = 1 AND (NOT has_own_wobj))
            ROS_set_fault ROS_REASON_NO_FRAME;
    ERROR
        RAISE;
    ENDPROC

    ! Read the values of a tool. Later poses refer to this tool, here and in the motion task.
    LOCAL PROC read_tool(VAR rawbytes data)
        read_frame data, instr.target;
        ! Centre of gravity and axes of inertia.
        read_frame data, instr.via;
        instr.load.cog := instr.via.trans;
        instr.load.aom := instr.via.rot;
        instr.load.mass := read_value(data);
        instr.load.ix := read_value(data);
        instr.load.iy := read_value(data);
        instr.load.iz := read_value(data);
        IF NOT (0 < instr.load.mass AND instr.load.mass <= MAX_MASS AND is_valid_inertia(instr.load.ix)
            AND is_valid_inertia(instr.load.iy) AND is_valid_inertia(instr.load.iz)) ROS_set_fault ROS_REASON_BAD_VALUE;
        IF ROS_point_fault <> ROS_REASON_NONE RETURN;
        ROS_own_tool := [TRUE,[instr.target.trans,instr.target.rot],instr.load];
        has_own_tool := TRUE;
        has_last_pose := FALSE;
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool is_valid_inertia(num value)
        RETURN 0 <= value AND value <= MAX_INERTIA;
    ENDFUNC

    ! Read the values of a work object: its user frame and its object frame.
    LOCAL PROC read_wobj(VAR rawbytes data)
        read_frame data, instr.target;
        read_frame data, instr.via;
        IF ROS_point_fault <> ROS_REASON_NONE RETURN;
        ROS_own_wobj := [FALSE,TRUE,"",[instr.target.trans,instr.target.rot],[instr.via.trans,instr.via.rot]];
        has_own_wobj := TRUE;
        has_last_pose := FALSE;
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC read_frame(VAR rawbytes data, INOUT robtarget target)
        read_pose data, target;
        IF NOT (VectMagn(target.trans) <= MAX_FRAME_MM) ROS_set_fault ROS_REASON_BAD_VALUE;
    ERROR
        RAISE;
    ENDPROC

    ! Read the signals that are set on the path.
    LOCAL PROC read_trigg_events(VAR rawbytes data)
        VAR num count;

        count := read_value(data);
        IF NOT (1 <= count AND count <= ROS_MAX_TRIGG_EVENTS) THEN
            ROS_set_fault ROS_REASON_BAD_VALUE;
            RETURN;
        ENDIF
        FOR n FROM 1 TO count DO
            trigg_event{n}.signal := read_value(data);
            trigg_event{n}.value := read_value(data);
            trigg_event{n}.kind := read_value(data);
            ! Convert m to mm; a time remains in s.
            trigg_event{n}.place := read_value(data);
            IF trigg_event{n}.kind <> ROS_TRIGG_TIME trigg_event{n}.place := 1000 * trigg_event{n}.place;
            ROS_set_fault check_signal_value(trigg_event{n}.signal, trigg_event{n}.value);
            IF NOT (0 <= trigg_event{n}.place AND trigg_event{n}.place <= MAX_TRIGG_PLACE) ROS_set_fault ROS_REASON_BAD_VALUE;
            IF trigg_event{n}.kind <> ROS_TRIGG_START AND trigg_event{n}.kind <> ROS_TRIGG_END AND trigg_event{n}.kind <> ROS_TRIGG_TIME
                ROS_set_fault ROS_REASON_BAD_VALUE;
        ENDFOR
        instr.trigg_events := count;
    ERROR
        RAISE;
    ENDPROC

    ! Return 0 if a signal can be set to this value, else the reason against it.
    LOCAL FUNC num check_signal_value(num signal, num value)
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

    ! Return 0 if a program can wait for this value of a signal, else the reason against it.
    LOCAL FUNC num check_wait_value(num signal, num value)
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

    ! Read the joints at the end of an instruction and check their limits.
    LOCAL PROC read_joints(VAR rawbytes data)
        VAR num joint_1;
        VAR num joint_2;
        VAR num joint_3;
        VAR num joint_4;
        VAR num joint_5;
        VAR num joint_6;

        read_word data;
        joint_1 := DnumToNum(word * DEG_PER_STEP);
        IF NOT (ROS_low{1} <= joint_1 AND joint_1 <= ROS_high{1})
            joint_1 := ROS_check_joint(joint_1, 0, 1);
        read_word data;
        joint_2 := DnumToNum(word * DEG_PER_STEP);
        IF NOT (ROS_low{2} <= joint_2 AND joint_2 <= ROS_high{2})
            joint_2 := ROS_check_joint(joint_2, 0, 2);
        read_word data;
        joint_3 := DnumToNum(word * DEG_PER_STEP);
        IF NOT (ROS_low{3} <= joint_3 AND joint_3 <= ROS_high{3})
            joint_3 := ROS_check_joint(joint_3, 0, 3);
        read_word data;
        joint_4 := DnumToNum(word * DEG_PER_STEP);
        IF NOT (ROS_low{4} <= joint_4 AND joint_4 <= ROS_high{4})
            joint_4 := ROS_check_joint(joint_4, 0, 4);
        read_word data;
        joint_5 := DnumToNum(word * DEG_PER_STEP);
        IF NOT (ROS_low{5} <= joint_5 AND joint_5 <= ROS_high{5})
            joint_5 := ROS_check_joint(joint_5, 0, 5);
        read_word data;
        joint_6 := DnumToNum(word * DEG_PER_STEP);
        IF NOT (ROS_low{6} <= joint_6 AND joint_6 <= ROS_high{6})
            joint_6 := ROS_check_joint(joint_6, 0, 6);
        instr.joints := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],[9E9,9E9,9E9,9E9,9E9,9E9]];
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC read_pose(VAR rawbytes data, INOUT robtarget target)
        VAR num norm;

        read_word data;
        target.trans.x := DnumToNum(word * MM_PER_STEP);
        read_word data;
        target.trans.y := DnumToNum(word * MM_PER_STEP);
        read_word data;
        target.trans.z := DnumToNum(word * MM_PER_STEP);
        read_word data;
        target.rot.q1 := DnumToNum(word / STEPS_PER_UNIT);
        read_word data;
        target.rot.q2 := DnumToNum(word / STEPS_PER_UNIT);
        read_word data;
        target.rot.q3 := DnumToNum(word / STEPS_PER_UNIT);
        read_word data;
        target.rot.q4 := DnumToNum(word / STEPS_PER_UNIT);
        norm := quaternion_dot(target.rot, target.rot);
        IF 0.99 < norm AND norm < 1.01 THEN
            target.rot := NOrient(target.rot);
        ELSE
            ROS_set_fault ROS_REASON_BAD_VALUE;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC num quaternion_dot(orient a, orient b)
        RETURN a.q1 * b.q1 + a.q2 * b.q2 + a.q3 * b.q3 + a.q4 * b.q4;
    ENDFUNC

    LOCAL FUNC robtarget pose_with_tool(PERS tooldata tool, jointtarget joints)
        TEST instr.wobj
        CASE 1:
            RETURN CalcRobT(joints, tool \WObj:=ROS_own_wobj);
        DEFAULT:
            RETURN CalcRobT(joints, tool \WObj:=wobj0);
        ENDTEST
    ERROR
        RAISE;
    ENDFUNC

    ! Return the pose that the joints reach.
    LOCAL FUNC robtarget pose_of(jointtarget joints)
        TEST instr.tool
        CASE 1:
            RETURN pose_with_tool(ROS_own_tool, joints);
        DEFAULT:
            RETURN pose_with_tool(tool0, joints);
        ENDTEST
    ERROR
        RAISE;
    ENDFUNC

    ! Check that the joints reach the target. Then set configuration and external axes of the target to
    ! those of the joints.
    LOCAL PROC resolve_pose()
        VAR robtarget actual;

        IF ROS_point_fault <> ROS_REASON_NONE RETURN;
        actual := pose_of(instr.joints);
        IF NOT (VectMagn(actual.trans - instr.target.trans) <= POSE_TOL_MM
            AND Abs(quaternion_dot(actual.rot, instr.target.rot)) >= POSE_TOL_COS)
            ROS_set_fault ROS_REASON_POSE_MISMATCH;
        instr.target.robconf := actual.robconf;
        instr.target.extax := actual.extax;
    ERROR
        SkipWarn;
        ROS_set_fault ROS_REASON_NO_GEOMETRY;
        RETURN;
    ENDPROC

    ! Check a circle from the end of the previous move. It may turn by 240 degrees at most. Then its two
    ! ends are at least 60 degrees apart, as seen from its circle point.
    LOCAL PROC resolve_circle()
        VAR pos to_start;
        VAR pos to_end;
        VAR pos chord;

        IF ROS_point_fault <> ROS_REASON_NONE RETURN;
        IF NOT has_last_pose last_pose := pose_of(last_joints);
        to_start := last_pose.trans - instr.via.trans;
        to_end := instr.target.trans - instr.via.trans;
        chord := instr.target.trans - last_pose.trans;
        IF VectMagn(to_start) < MIN_CIRCLE_MM OR VectMagn(to_end) < MIN_CIRCLE_MM
            OR VectMagn(to_start * chord) < MIN_CIRCLE_SINE * VectMagn(to_start) * VectMagn(chord)
            OR DotProd(to_start, to_end) > 0.5 * VectMagn(to_start) * VectMagn(to_end)
            ROS_set_fault ROS_REASON_NO_CIRCLE;
    ERROR
        SkipWarn;
        ROS_set_fault ROS_REASON_NO_GEOMETRY;
        RETURN;
    ENDPROC

    LOCAL PROC resolve_joints()
        IF ROS_point_fault <> ROS_REASON_NONE RETURN;
        instr.target := pose_of(instr.joints);
        instr.kind := ROS_DO_MOVE_J;
    ERROR
        SkipWarn;
        ROS_set_fault ROS_REASON_NO_GEOMETRY;
        RETURN;
    ENDPROC
ENDMODULE
