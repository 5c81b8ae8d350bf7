MODULE ROS_probe
    ! Questions to a controller, about what no manual settles. Load this module alone into a
    ! NORMAL task, PP to main, Start, and read the pendant (or the event log, 80003). Each line
    ! is an answer, `switch=value`, as `rapidgen run --assume` and the test suite take it.
    !
    ! Nothing here moves a robot, sets an output or opens a socket. A line that begins with
    ! "! If the program stops now:" is the answer of the question that stopped it; then go on with
    ! the next `ask_` routine. The last question may well do so.

    ! 11 x 2^32: two int32 as one 64-bit number, the second one 11, but for the first.
    LOCAL CONST dnum PAIR := 47244640256;
    LOCAL CONST num FIRST := 64;
    LOCAL CONST num SECOND := 11;

    LOCAL VAR intnum alarm;
    LOCAL PERS bool rung := FALSE;
    LOCAL PERS num heard := 0;
    PERS num ROS_probe_find := 0;
    LOCAL VAR clock watch;
    LOCAL VAR signaldo no_signal;
    LOCAL VAR rawbytes bytes;

    PROC main()
        ask_num_rounding;
        ask_dnum_whole;
        ask_for_loop;
        ask_integer_division;
        ask_negative_mod;
        ask_wait_until;
        ask_unpack_ulint;
        ask_unpack_beyond;
        ask_pack_beyond;
        ask_find_behind;
        ask_byte_to_str;
        ask_alias_by_name;
        ask_axis_limits;
        ask_own_events;
        ask_calc_in_background;
        ask_modules;
        ask_symbols;
        ask_data_of_tasks;
        ask_argument_error;
        tell_interrupt_delay;
        tell_statement_time;
        tell_raw_bytes_time;
        ask_unhandled_error;
    ENDPROC

    LOCAL PROC answer(string line)
        TPWrite line;
        ErrWrite \I, "ROS probe", line;
    ENDPROC

    ! Is a num rounded between the operators of one expression?
    LOCAL PROC ask_num_rounding()
        VAR num large := 16777216;
        VAR num small := 0.25;
        VAR num left;

        left := large + small - large;
        IF left = 0.25 THEN
            answer "num_rounding=store";
        ELSE
            answer "num_rounding=operation";
        ENDIF
    ENDPROC

    ! Does a dnum count whole numbers behind 2^52?
    LOCAL PROC ask_dnum_whole()
        VAR dnum large := 4503599627370496;
        VAR dnum one := 1;
        VAR dnum more;

        more := large + one;
        IF more - large = one THEN
            answer "dnum_whole=53";
        ELSE
            answer "dnum_whole=52";
        ENDIF
    ENDPROC

    ! Does FOR count down by itself, and run at least once?
    LOCAL PROC ask_for_loop()
        VAR num passes := 0;

        FOR i FROM 1 TO 0 DO
            passes := passes + 1;
        ENDFOR
        IF passes = 2 THEN
            answer "for_loop=kernel";
        ELSEIF passes = 0 THEN
            answer "for_loop=tested";
        ELSE
            answer "! FOR i FROM 1 TO 0 made " + ValToStr(passes) + " passes";
        ENDIF
    ENDPROC

    ! How is a negative quotient cut?
    LOCAL PROC ask_integer_division()
        VAR num seven := -7;

        IF seven DIV 2 = -3 THEN
            answer "integer_division=truncate";
        ELSE
            answer "integer_division=floor";
        ENDIF
    ENDPROC

    ! May the left operand of MOD be negative?
    LOCAL PROC ask_negative_mod()
        VAR num seven := -7;
        VAR num rest;

        rest := seven MOD 3;
        IF rest < 3 answer "negative_mod=allow";
    ERROR
        SkipWarn;
        answer "negative_mod=error";
        RETURN;
    ENDPROC

    ! Is WaitUntil woken by a change, or does it look every 100 ms?
    LOCAL PROC ask_wait_until()
        VAR num waited;

        rung := FALSE;
        IDelete alarm;
        CONNECT alarm WITH on_alarm;
        ClkReset watch;
        ClkStart watch;
        ITimer \Single, 0.02, alarm;
        WaitUntil rung;
        waited := ClkRead(watch);
        ClkStop watch;
        IDelete alarm;
        IF waited < 0.08 THEN
            answer "wait_until=event";
        ELSE
            answer "wait_until=polled";
        ENDIF
    ENDPROC

    LOCAL TRAP on_alarm
        rung := TRUE;
    ENDTRAP

    ! Do two int32 make one ULINT, whole in a dnum?
    LOCAL PROC ask_unpack_ulint()
        VAR dnum both := 0;

        ClearRawBytes bytes;
        PackRawBytes FIRST, bytes, 1 \IntX:=DINT;
        PackRawBytes SECOND, bytes, 5 \IntX:=DINT;
        UnpackRawBytes bytes, 1, both \IntX:=ULINT;
        both := both - PAIR;
        IF both = 64 THEN
            answer "unpack_ulint=exact";
        ELSE
            answer "unpack_ulint=single";
        ENDIF
    ERROR
        SkipWarn;
        answer "unpack_ulint=error";
        RETURN;
    ENDPROC

    ! What lies behind the valid bytes?
    LOCAL PROC ask_unpack_beyond()
        VAR num nothing := 1;

        ClearRawBytes bytes;
        PackRawBytes FIRST, bytes, 1 \IntX:=DINT;
        UnpackRawBytes bytes, 5, nothing \IntX:=DINT;
        IF nothing = 0 answer "unpack_beyond=zero";
    ERROR
        SkipWarn;
        answer "unpack_beyond=error";
        RETURN;
    ENDPROC

    ! May a message be packed with a gap, and what lies in it?
    LOCAL PROC ask_pack_beyond()
        VAR num nothing := 1;

        ClearRawBytes bytes;
        PackRawBytes FIRST, bytes, 1 \IntX:=DINT;
        PackRawBytes SECOND, bytes, 9 \IntX:=DINT;
        UnpackRawBytes bytes, 5, nothing \IntX:=DINT;
        IF nothing = 0 answer "pack_beyond=zero";
    ERROR
        SkipWarn;
        answer "pack_beyond=error";
        RETURN;
    ENDPROC

    ! May a search begin right behind the text?
    LOCAL PROC ask_find_behind()
        VAR num place;

        place := StrFind("a", 2, STR_DIGIT);
        IF place = 2 answer "find_past_end=none";
    ERROR
        SkipWarn;
        answer "find_past_end=error";
        RETURN;
    ENDPROC

    ! Is a control character itself, or written out?
    LOCAL PROC ask_byte_to_str()
        IF StrLen(ByteToStr(10 \Char)) = 1 THEN
            answer "byte_to_str=character";
        ELSE
            answer "byte_to_str=code";
        ENDIF
    ENDPROC

    ! Does AliasIO take a name, and is one that nothing has an error that can be handled?
    LOCAL PROC ask_alias_by_name()
        VAR string name := "no_signal_has_this_name";

        answer "! If the program stops now: alias_by_name=false";
        AliasIO name, no_signal;
    ERROR
        SkipWarn;
        answer "alias_by_name=true";
        RETURN;
    ENDPROC

    ! Does the controller tell the limits of its axes, and in rad?
    LOCAL PROC ask_axis_limits()
        VAR num lowest := 0;
        VAR num highest := 0;

        ReadCfgData "/MOC/ARM/rob1_1", "lower_joint_bound", lowest;
        ReadCfgData "/MOC/ARM/rob1_1", "upper_joint_bound", highest;
        answer "axis_limits_readable=true";
        answer "! axis 1: " + ValToStr(lowest) + " to " + ValToStr(highest) + " (rad?)";
    ERROR
        SkipWarn;
        answer "axis_limits_readable=false";
        RETURN;
    ENDPROC

    ! Is the pose of joints computed in a task that moves no robot? Asked when this module is loaded into
    ! such a task.
    LOCAL PROC ask_calc_in_background()
        VAR robtarget there;

        IF TaskRunMec() RETURN;
        there := CalcRobT([[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], tool0);
        answer "calc_in_background=true";
        answer "! z: " + ValToStr(there.trans.z);
    ERROR
        SkipWarn;
        answer "calc_in_background=false";
        RETURN;
    ENDPROC

    ! Does ModExist tell of a module that belongs to the task?
    LOCAL PROC ask_modules()
        IF ModExist("ROS_probe") THEN
            answer "installed_modules_exist=true";
        ELSE
            answer "installed_modules_exist=false";
        ENDIF
    ENDPROC

    ! What does a search find: by a part of a name, and in modules without an explicit module?
    LOCAL PROC ask_symbols()
        VAR datapos block;
        VAR string name;

        SetDataSearch "num" \Object:="^ROS_probe_fin" \InMod:="ROS_probe";
        IF GetNextSym(name, block) THEN
            answer "search_pattern=part";
        ELSE
            answer "search_pattern=whole";
        ENDIF
        SetDataSearch "num" \Object:="^ROS_probe_find$";
        IF GetNextSym(name, block) THEN
            answer "next_symbol=below";
        ELSE
            answer "next_symbol=level";
        ENDIF
        SetDataSearch "num" \Object:="^ROS_probe_find$" \PersSym \InMod:="ROS_probe" \GlobalSym;
        IF GetNextSym(name, block) THEN
            answer "! the driver's search for a datum finds it";
        ELSE
            answer "! the driver's search for a datum does not find it";
        ENDIF
    ENDPROC

    ! Is a persistent of another task reached by its name? Asked when this module is loaded into a task
    ! without a robot, and into T_ROB1.
    LOCAL PROC ask_data_of_tasks()
        VAR num found;

        IF TaskRunMec() RETURN;
        GetDataVal "ROS_probe_find" \TaskName:="T_ROB1", found;
        answer "data_of_tasks=true";
    ERROR
        SkipWarn;
        answer "data_of_tasks=false";
        answer "! unless T_ROB1 has no module ROS_probe";
        RETURN;
    ENDPROC

    ! Does a message of one's own make an interrupt? (Whether others' do needs a second task.)
    LOCAL PROC ask_own_events()
        rung := FALSE;
        IDelete alarm;
        CONNECT alarm WITH on_alarm;
        IError COMMON_ERR, TYPE_ALL, alarm;
        ErrWrite \I, "ROS probe", "Is this heard?";
        WaitTime 0.5;
        IDelete alarm;
        IF rung THEN
            answer "! IError hears ErrWrite: yes";
        ELSE
            answer "! IError hears ErrWrite: no";
        ENDIF
    ENDPROC

    ! Does a handler get the error of an argument that an instruction refuses?
    LOCAL PROC ask_argument_error()
        VAR num large := 4294967296;

        ClearRawBytes bytes;
        answer "! If the program stops now: argument_error=fatal";
        PackRawBytes large, bytes, 1 \IntX:=DINT;
        answer "! PackRawBytes takes a DINT that does not fit";
    ERROR
        SkipWarn;
        answer "argument_error=recoverable";
        RETURN;
    ENDPROC

    ! How long does a TRAP let itself be waited for, after a change of a persistent?
    LOCAL PROC tell_interrupt_delay()
        VAR num longest := 0;
        VAR num count := 50;

        IDelete alarm;
        CONNECT alarm WITH on_alarm;
        IPers heard, alarm;
        FOR i FROM 1 TO count DO
            rung := FALSE;
            ClkReset watch;
            ClkStart watch;
            heard := i;
            WHILE NOT rung AND ClkRead(watch) < 1 DO
            ENDWHILE
            IF ClkRead(watch) > longest longest := ClkRead(watch);
            ClkStop watch;
        ENDFOR
        IDelete alarm;
        answer "! milliseconds from a PERS to its TRAP, at most: " + NumToStr(1000 * longest, 0);
    ENDPROC

    ! What a raw-bytes instruction costs here, for the cost model.
    LOCAL PROC tell_raw_bytes_time()
        VAR num count := 2000;

        ClearRawBytes bytes;
        ClkReset watch;
        ClkStart watch;
        FOR i FROM 1 TO count DO
            PackRawBytes i, bytes, 1 \Float4;
        ENDFOR
        ClkStop watch;
        answer "! microseconds a PackRawBytes: " + NumToStr(1000000 * ClkRead(watch) / count, 1);
    ENDPROC

    ! What a statement costs here, for the cost model.
    LOCAL PROC tell_statement_time()
        VAR num sum := 0;
        VAR num count := 20000;

        ClkReset watch;
        ClkStart watch;
        FOR i FROM 1 TO count DO
            sum := sum + 1;
        ENDFOR
        ClkStop watch;
        answer "! microseconds a pass: " + NumToStr(1000000 * ClkRead(watch) / count, 2);
    ENDPROC

    ! Does an error reach the caller through a routine without a handler?
    LOCAL PROC ask_unhandled_error()
        answer "! If the program stops now: unhandled_error=stop";
        without_handler;
    ERROR
        SkipWarn;
        answer "unhandled_error=propagate";
        RETURN;
    ENDPROC

    LOCAL PROC without_handler()
        VAR num zero := 0;

        zero := 1 / zero;
    ENDPROC
ENDMODULE
