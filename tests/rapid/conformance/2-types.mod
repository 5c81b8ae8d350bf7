!=== accdata_of_any_release
! rule: values that older releases saved lack components
! source: [backup] RobotWare 6.13 has finepramp in accdata, earlier ones have not
MODULE Demo
    PERS accdata older := [100, 100];
    PERS accdata newer := [100, 100, 50];
    PERS accdata short := [100];  ! -> RG330
    PROC main()
        newer.finepramp := older.acc;
    ENDPROC
ENDMODULE
!=== alias_aiotrigg
! rule: aiotrigg is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR aiotrigg a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_btnres
! rule: btnres is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR btnres a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_buttondata
! rule: buttondata is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR buttondata a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_byte
! rule: byte is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_dionum
! rule: dionum is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR dionum a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_errdomain
! rule: errdomain is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR errdomain a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_errnum
! rule: errnum is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR errnum a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_errtype
! rule: errtype is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR errtype a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_event_type
! rule: event_type is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR event_type a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_exec_level
! rule: exec_level is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR exec_level a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_handler_type
! rule: handler_type is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR handler_type a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_icondata
! rule: icondata is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR icondata a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_identno
! rule: identno is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_intnum
! rule: intnum is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_inttypes
! rule: inttypes is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR inttypes a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_opcalc
! rule: opcalc is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR opcalc a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_opnum
! rule: opnum is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR opnum a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_socketstatus
! rule: socketstatus is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketstatus a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_stringdig
! rule: stringdig is string
! source: [manual] 3HAC050917
MODULE Demo
    VAR stringdig a;
    VAR string s;
    PROC main()
        a := s;
        s := a;
        a := 1;  ! -> RG307
    ENDPROC
ENDMODULE
!=== alias_symnum
! rule: symnum is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR symnum a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
!=== constants_analog
! rule: named values: analog
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := AIO_ABOVE_HIGH;
        n := AIO_BELOW_HIGH;
        n := AIO_ABOVE_LOW;
        n := AIO_BELOW_LOW;
        n := AIO_BETWEEN;
        n := AIO_OUTSIDE;
        n := AIO_ALWAYS;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_dialogs
! rule: named values: dialogs
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := resUnkwn;
        n := resOK;
        n := resAbort;
        n := resRetry;
        n := resIgnore;
        n := resCancel;
        n := resYes;
        n := resNo;
        n := btnNone;
        n := btnOK;
        n := btnAbrtRtryIgn;
        n := btnOKCancel;
        n := btnRetryCancel;
        n := btnYesNo;
        n := btnYesNoCancel;
        n := iconNone;
        n := iconInfo;
        n := iconWarning;
        n := iconError;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_egm
! rule: named values: egm
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := EGM_STATE_DISCONNECTED;
        n := EGM_STATE_CONNECTED;
        n := EGM_STATE_RUNNING;
        n := EGM_STOP_HOLD;
        n := EGM_STOP_RAMP_DOWN;
        n := EGM_FRAME_BASE;
        n := EGM_FRAME_TOOL;
        n := EGM_FRAME_WOBJ;
        n := EGM_FRAME_WORLD;
        n := EGM_FRAME_JOINT;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_event_log
! rule: named values: types of events
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errtype e;
    PROC main()
        e := TYPE_ALL;
        e := TYPE_STATE;
        e := TYPE_WARN;
        e := TYPE_ERR;
        e := TYPE_INFO;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_events
! rule: named values: events
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := EVENT_NONE;
        n := EVENT_POWERON;
        n := EVENT_START;
        n := EVENT_STOP;
        n := EVENT_QSTOP;
        n := EVENT_RESTART;
        n := EVENT_RESET;
        n := EVENT_STEP;
        n := HANDLER_NONE;
        n := HANDLER_BWD;
        n := HANDLER_ERR;
        n := HANDLER_UNDO;
        n := LEVEL_NORMAL;
        n := LEVEL_TRAP;
        n := LEVEL_SERVICE;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_inttypes
! rule: named values: inttypes
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := USINT;
        n := UINT;
        n := UDINT;
        n := ULINT;
        n := SINT;
        n := INT;
        n := DINT;
        n := LINT;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_modes
! rule: named values: modes
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := OP_UNDEF;
        n := OP_AUTO;
        n := OP_MAN_PROG;
        n := OP_MAN_TEST;
        n := RUN_UNDEF;
        n := RUN_CONT_CYCLE;
        n := RUN_INSTR_FWD;
        n := RUN_INSTR_BWD;
        n := RUN_SIM;
        n := RUN_STEP_MOVE;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_relations
! rule: named values: relations
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := LT;
        n := LTEQ;
        n := EQ;
        n := NOTEQ;
        n := GTEQ;
        n := GT;
        n := OpAdd;
        n := OpSub;
        n := OpMult;
        n := OpDiv;
        n := OpMod;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== constants_sockets
! rule: named values: sockets
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := SOCKET_CREATED;
        n := SOCKET_CONNECTED;
        n := SOCKET_BOUND;
        n := SOCKET_LISTENING;
        n := SOCKET_CLOSED;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
!=== non_value_clock
! rule: clock is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock a;
    VAR clock b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_dir
! rule: dir is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir a;
    VAR dir b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_egmident
! rule: egmident is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident a;
    VAR egmident b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_iodev
! rule: iodev is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev a;
    VAR iodev b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_loadsession
! rule: loadsession is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession a;
    VAR loadsession b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_mecunit
! rule: mecunit is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit a;
    VAR mecunit b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_rawbytes
! rule: rawbytes is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes a;
    VAR rawbytes b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_rmqmessage
! rule: rmqmessage is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqmessage a;
    VAR rmqmessage b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_rmqslot
! rule: rmqslot is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot a;
    VAR rmqslot b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_shapedata
! rule: shapedata is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR shapedata a;
    VAR shapedata b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_socketdev
! rule: socketdev is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev a;
    VAR socketdev b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_syncident
! rule: syncident is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR syncident a;
    VAR syncident b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_taskid
! rule: taskid is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid a;
    VAR taskid b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_trapdata
! rule: trapdata is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR trapdata a;
    VAR trapdata b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_triggdata
! rule: triggdata is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata a;
    VAR triggdata b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
!=== record_bool_components
! rule: finep and robhold are bool, ufprog too
! source: [manual] 3HAC050917
MODULE Demo
    VAR zonedata z;
    VAR tooldata t;
    VAR wobjdata w;
    VAR tasks k;
    VAR bool b;
    VAR string s;
    PROC main()
        b := z.finep;
        b := t.robhold;
        b := w.ufprog;
        s := w.ufmec;
        s := k.taskname;
    ENDPROC
ENDMODULE
!=== record_confdata
! rule: components of confdata
! source: [manual] 3HAC050917
MODULE Demo
    VAR confdata a;
    VAR num n;
    PROC main()
        n := a.cf1;
        n := a.cf4;
        n := a.cf6;
        n := a.cfx;
        n := a.cf1_;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_confdata_order
! rule: confdata has 4 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR confdata a;
    PROC main()
        a := [1, 1, 1, 1];
        a := [1, 1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
!=== record_egm_minmax
! rule: components of egm_minmax
! source: [manual] 3HAC050917
MODULE Demo
    VAR egm_minmax a;
    VAR num n;
    PROC main()
        n := a.min;
        n := a.max;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_extjoint
! rule: components of extjoint
! source: [manual] 3HAC050917
MODULE Demo
    VAR extjoint a;
    VAR num n;
    PROC main()
        n := a.eax_a;
        n := a.eax_b;
        n := a.eax_c;
        n := a.eax_d;
        n := a.eax_e;
        n := a.eax_f;
        n := a.eax_a_;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_extjoint_order
! rule: extjoint has 6 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR extjoint a;
    PROC main()
        a := [1, 1, 1, 1, 1, 1];
        a := [1, 1, 1, 1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
!=== record_jointtarget
! rule: components of jointtarget
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget a;
    VAR num n;
    PROC main()
        n := a.robax.rax_1;
        n := a.extax.eax_a;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_listitem
! rule: components of listitem
! source: [code] rapid-for-vim
MODULE Demo
    VAR listitem a := ["T_ROB1", "T_ROB1"];
    VAR string s;
    PROC main()
        s := a.image;
        s := a.text;
        s := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_loaddata
! rule: components of loaddata
! source: [manual] 3HAC050917
MODULE Demo
    VAR loaddata a;
    VAR num n;
    PROC main()
        n := a.mass;
        n := a.cog.x;
        n := a.aom.q1;
        n := a.ix;
        n := a.iy;
        n := a.iz;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_orient
! rule: components of orient
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient a;
    VAR num n;
    PROC main()
        n := a.q1;
        n := a.q2;
        n := a.q3;
        n := a.q4;
        n := a.q1_;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_orient_order
! rule: orient has 4 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient a;
    PROC main()
        a := [1, 1, 1, 1];
        a := [1, 1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
!=== record_pos
! rule: components of pos
! source: [manual] 3HAC050917
MODULE Demo
    VAR pos a;
    VAR num n;
    PROC main()
        n := a.x;
        n := a.y;
        n := a.z;
        n := a.x_;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_pos_order
! rule: pos has 3 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR pos a;
    PROC main()
        a := [1, 1, 1];
        a := [1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
!=== record_pose
! rule: components of pose
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose a;
    VAR num n;
    PROC main()
        n := a.trans.x;
        n := a.rot.q1;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_progdisp
! rule: components of progdisp
! source: [manual] 3HAC050917
MODULE Demo
    VAR progdisp a;
    VAR num n;
    PROC main()
        n := a.pdisp.trans.x;
        n := a.eoffs.eax_a;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_robjoint
! rule: components of robjoint
! source: [manual] 3HAC050917
MODULE Demo
    VAR robjoint a;
    VAR num n;
    PROC main()
        n := a.rax_1;
        n := a.rax_2;
        n := a.rax_3;
        n := a.rax_4;
        n := a.rax_5;
        n := a.rax_6;
        n := a.rax_1_;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_robjoint_order
! rule: robjoint has 6 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR robjoint a;
    PROC main()
        a := [1, 1, 1, 1, 1, 1];
        a := [1, 1, 1, 1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
!=== record_robtarget
! rule: components of robtarget
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget a;
    VAR num n;
    PROC main()
        n := a.trans.x;
        n := a.rot.q1;
        n := a.robconf.cf1;
        n := a.extax.eax_f;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_speeddata
! rule: components of speeddata
! source: [manual] 3HAC050917
MODULE Demo
    VAR speeddata a;
    VAR num n;
    PROC main()
        n := a.v_tcp;
        n := a.v_ori;
        n := a.v_leax;
        n := a.v_reax;
        n := a.v_tcp_;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_speeddata_order
! rule: speeddata has 4 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR speeddata a;
    PROC main()
        a := [1, 1, 1, 1];
        a := [1, 1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
!=== record_stoppointdata
! rule: components of stoppointdata
! source: [manual] 3HAC050917
MODULE Demo
    VAR stoppointdata a;
    VAR num n;
    PROC main()
        n := a.inpos.position;
        n := a.stoptime;
        n := a.followtime;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_tasks
! rule: components of tasks
! source: [manual] 3HAC050917, an initial value of one string
MODULE Demo
    VAR tasks a := ["T_ROB1"];
    VAR string s;
    PROC main()
        s := a.taskname;
        s := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_tooldata
! rule: components of tooldata
! source: [manual] 3HAC050917
MODULE Demo
    VAR tooldata a;
    VAR num n;
    PROC main()
        n := a.tframe.trans.x;
        n := a.tload.mass;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_wobjdata
! rule: components of wobjdata
! source: [manual] 3HAC050917
MODULE Demo
    VAR wobjdata a;
    VAR num n;
    PROC main()
        n := a.uframe.trans.x;
        n := a.oframe.rot.q4;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== record_zonedata
! rule: components of zonedata
! source: [manual] 3HAC050917
MODULE Demo
    VAR zonedata a;
    VAR num n;
    PROC main()
        n := a.pzone_tcp;
        n := a.pzone_ori;
        n := a.pzone_eax;
        n := a.zone_ori;
        n := a.zone_leax;
        n := a.zone_reax;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
!=== semivalue_signalai
! rule: signalai reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signalai a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
!=== semivalue_signalao
! rule: signalao reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signalao a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
!=== semivalue_signaldi
! rule: signaldi reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signaldi a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
!=== semivalue_signaldo
! rule: signaldo reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signaldo a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
!=== semivalue_signalgi
! rule: signalgi reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signalgi a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
!=== semivalue_signalgo
! rule: signalgo reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signalgo a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
!=== speeds
! rule: predefined speeds
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR speeddata s;
    PROC main()
        s := v5;
        s := v10;
        s := v20;
        s := v30;
        s := v40;
        s := v50;
        s := v60;
        s := v80;
        s := v100;
        s := v150;
        s := v200;
        s := v300;
        s := v400;
        s := v500;
        s := v600;
        s := v800;
        s := v1000;
        s := v1500;
        s := v2000;
        s := v2500;
        s := v3000;
        s := v4000;
        s := v5000;
        s := v6000;
        s := v7000;
        s := vmax;
        s := 1;  ! -> RG307
    ENDPROC
ENDMODULE
!=== speeds_of_axes
! rule: predefined speeds of rotating and linear external axes
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR speeddata s;
    PROC main()
        s := vrot1;
        s := vrot2;
        s := vrot5;
        s := vrot10;
        s := vrot20;
        s := vrot50;
        s := vrot100;
        s := vlin10;
        s := vlin20;
        s := vlin50;
        s := vlin100;
        s := vlin200;
        s := vlin500;
        s := vlin1000;
        s := vrot3;  ! -> RG302
    ENDPROC
ENDMODULE
!=== stop_points
! rule: predefined stop points
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR stoppointdata s;
    PROC main()
        s := inpos20;
        s := inpos50;
        s := inpos100;
        s := stoptime0_5;
        s := stoptime1_0;
        s := stoptime1_5;
        s := fllwtime0_5;
        s := fllwtime1_0;
        s := fllwtime1_5;
        s := inpos30;  ! -> RG302
    ENDPROC
ENDMODULE
!=== tool_work_object_load
! rule: tool0, wobj0 and load0
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR tooldata t;
    VAR wobjdata w;
    VAR loaddata l;
    PROC main()
        t := tool0;
        w := wobj0;
        l := load0;
        l := tool0;  ! -> RG307
    ENDPROC
ENDMODULE
!=== vmax_may_be_set
! rule: vmax may be assigned
! source: [backup] programs of two cells with RobotWare 5.61
MODULE Demo
    CONST speeddata quick := vmax;
    PROC main()
        vmax := v2500;
        vmax.v_tcp := quick.v_tcp;
        v100.v_tcp := 3;  ! -> RG310
    ENDPROC
ENDMODULE
!=== world_zones_are_values
! rule: world zones are values, with an initial value, of any mode
! source: [backup] of RobotWare 5.61 to 6.16; [code] cells of running robots
MODULE Demo
    PERS wzstationary service := [1];
    VAR wztemporary zone;
    PROC main()
        limit service;
        WZFree zone;
    ENDPROC
    PROC limit(INOUT wzstationary wz)
        VAR shapedata volume;
        WZBoxDef \Inside, volume, [0, 0, 0], [1, 1, 1];
        WZLimSup \Stat, wz, volume;
    ENDPROC
ENDMODULE
!=== zones
! rule: predefined zones
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR zonedata z;
    PROC main()
        z := fine;
        z := z0;
        z := z1;
        z := z5;
        z := z10;
        z := z15;
        z := z20;
        z := z30;
        z := z40;
        z := z50;
        z := z60;
        z := z80;
        z := z100;
        z := z150;
        z := z200;
        z := 1;  ! -> RG307
    ENDPROC
ENDMODULE
