!=== gettrapdata
! rule: arguments of GetTrapData
! source: [manual] 3HAC050917
MODULE Demo
    VAR trapdata v_trapdata;
    PROC main()
        GetTrapData v_trapdata;
        GetTrapData;  ! -> RG311?
        GetTrapData v_trapdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== idelete
! rule: arguments of IDelete
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        IDelete v_intnum;
        IDelete;  ! -> RG311?
        IDelete v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== idisable
! rule: arguments of IDisable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IDisable;
        IDisable 1;  ! -> RG311
        IDisable \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ienable
! rule: arguments of IEnable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IEnable;
        IEnable 1;  ! -> RG311
        IEnable \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ierror
! rule: arguments of IError
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        IError 1, 1, v_intnum;
        IError 1 \ErrorId:=1, 1, v_intnum;
        IError 1, 1;  ! -> RG311
        IError 1, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ipathpos
! rule: arguments of IPathPos
! source: [manual] 3HAC050917
MODULE Demo
    PERS robtarget p_robtarget;
    PERS pos p_pos;
    VAR intnum v_intnum;
    PROC main()
        IPathPos p_robtarget, p_pos, v_intnum;
        IPathPos p_robtarget, p_pos, v_intnum \EOffs \NoDispl;
        IPathPos p_robtarget, p_pos;  ! -> RG311
        IPathPos p_robtarget, p_pos, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ipers
! rule: arguments of IPers
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    VAR intnum v_intnum;
    PROC main()
        IPers p_num, v_intnum;
        IPers \Single, p_num, v_intnum;
        IPers \SingleSafe, p_num, v_intnum;
        IPers p_num;  ! -> RG311
        IPers p_num, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== irmqmessage
! rule: arguments of IRMQMessage
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR intnum v_intnum;
    PROC main()
        IRMQMessage v_num, v_intnum;
        IRMQMessage v_num;  ! -> RG311
        IRMQMessage v_num, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== isignalai
! rule: arguments of ISignalAI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalai s;
    VAR intnum i;
    PROC main()
        ISignalAI s, AIO_BETWEEN, 1, 2, 0, i;
        ISignalAI \Single, s, AIO_ALWAYS, 1, 2, 0 \DPos, i;
        ISignalAI \SingleSafe, s, AIO_ALWAYS, 1, 2, 0 \DNeg, i;
        ISignalAI s, AIO_ALWAYS, 1, 2, 0;  ! -> RG311
        ISignalAI s, AIO_ALWAYS, 1, 2, 0 \DPos \DNeg, i;  ! -> RG313
    ENDPROC
ENDMODULE
!=== isignalao
! rule: arguments of ISignalAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao s;
    VAR intnum i;
    PROC main()
        ISignalAO s, AIO_BETWEEN, 1, 2, 0, i;
        ISignalAO \Single, s, AIO_ALWAYS, 1, 2, 0 \DPos, i;
        ISignalAO \SingleSafe, s, AIO_ALWAYS, 1, 2, 0 \DNeg, i;
        ISignalAO s, AIO_ALWAYS, 1, 2, 0;  ! -> RG311
        ISignalAO s, AIO_ALWAYS, 1, 2, 0 \DPos \DNeg, i;  ! -> RG313
    ENDPROC
ENDMODULE
!=== isignaldi
! rule: arguments of ISignalDI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldi v_signaldi;
    VAR intnum v_intnum;
    PROC main()
        ISignalDI v_signaldi, 1, v_intnum;
        ISignalDI \Single, v_signaldi, 1, v_intnum;
        ISignalDI \SingleSafe, v_signaldi, 1, v_intnum;
        ISignalDI v_signaldi, 1;  ! -> RG311
        ISignalDI v_signaldi, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== isignaldo
! rule: arguments of ISignalDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    VAR intnum v_intnum;
    PROC main()
        ISignalDO v_signaldo, 1, v_intnum;
        ISignalDO \Single, v_signaldo, 1, v_intnum;
        ISignalDO \SingleSafe, v_signaldo, 1, v_intnum;
        ISignalDO v_signaldo, 1;  ! -> RG311
        ISignalDO v_signaldo, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== isignalgi
! rule: arguments of ISignalGI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi v_signalgi;
    VAR intnum v_intnum;
    PROC main()
        ISignalGI v_signalgi, v_intnum;
        ISignalGI \Single, v_signalgi, v_intnum;
        ISignalGI \SingleSafe, v_signalgi, v_intnum;
        ISignalGI v_signalgi;  ! -> RG311
        ISignalGI v_signalgi, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== isignalgo
! rule: arguments of ISignalGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    VAR intnum v_intnum;
    PROC main()
        ISignalGO v_signalgo, v_intnum;
        ISignalGO \Single, v_signalgo, v_intnum;
        ISignalGO \SingleSafe, v_signalgo, v_intnum;
        ISignalGO v_signalgo;  ! -> RG311
        ISignalGO v_signalgo, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== isleep
! rule: arguments of ISleep
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        ISleep v_intnum;
        ISleep;  ! -> RG311?
        ISleep v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== itimer
! rule: arguments of ITimer
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        ITimer 1, v_intnum;
        ITimer \Single, 1, v_intnum;
        ITimer \SingleSafe, 1, v_intnum;
        ITimer 1;  ! -> RG311
        ITimer 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ivarvalue
! rule: arguments of IVarValue
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    VAR intnum v_intnum;
    PROC main()
        IVarValue "x", 1, p_num, v_intnum;
        IVarValue "x", 1, p_num, v_intnum \Unit:=1 \DeadBand:=1 \ReportAtTool \SpeedAdapt:=1 \APTR;
        IVarValue "x", 1, p_num;  ! -> RG311
        IVarValue "x", 1, p_num, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== iwatch
! rule: arguments of IWatch
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        IWatch v_intnum;
        IWatch;  ! -> RG311?
        IWatch v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== readerrdata
! rule: arguments of ReadErrData
! source: [manual] 3HAC050917
MODULE Demo
    VAR trapdata v_trapdata;
    VAR errdomain v_errdomain;
    VAR num v_num;
    VAR errtype v_errtype;
    VAR string v_string;
    PROC main()
        ReadErrData v_trapdata, v_errdomain, v_num, v_errtype;
        ReadErrData v_trapdata, v_errdomain, v_num, v_errtype \Title:=v_string \Str1:=v_string \Str2:=v_string \Str3:=v_string \Str4:=v_string \Str5:=v_string;
        ReadErrData v_trapdata, v_errdomain, v_num;  ! -> RG311
        ReadErrData v_trapdata, v_errdomain, v_num, v_errtype \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggc
! rule: arguments of TriggC
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    VAR triggdata g;
    VAR triggdata a{3};
    PROC main()
        TriggC p, p, v100, g, fine, tool0;
        TriggC \Conc, p, p \ID:=1, v100 \T:=2, g \T2:=g \T3:=g \T4:=g \T5:=g \T6:=g \T7:=g \T8:=g, z10 \Inpos:=inpos50, tool0 \WObj:=w \Corr \TLoad:=l;
        TriggC p, p, v100, a, fine, tool0;
        TriggC p, p, v100, g, fine;  ! -> RG311
    ENDPROC
ENDMODULE
!=== triggcheckio
! rule: arguments of TriggCheckIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR num v_num;
    VAR intnum v_intnum;
    PERS bool p_bool;
    PROC main()
        TriggCheckIO v_triggdata, 1, v_num, 1, 1, v_intnum;
        TriggCheckIO v_triggdata, 1 \Start, v_num, 1, 1 \StopMove, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggCheckIO v_triggdata, 1 \Next, v_num, 1, 1 \StopMove, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggCheckIO v_triggdata, 1 \Time, v_num, 1, 1 \StopMove, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggCheckIO v_triggdata, 1, v_num, 1, 1;  ! -> RG311
        TriggCheckIO v_triggdata, 1, v_num, 1, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggequip
! rule: arguments of TriggEquip
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    PERS num p_num;
    VAR signalgo v_signalgo;
    VAR signalao v_signalao;
    PROC main()
        TriggEquip v_triggdata, 1, 1, 1;
        TriggEquip v_triggdata, 1 \Start, 1 \DOp:=v_signaldo, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1 \Next, 1 \GOp:=v_signalgo, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1 \Start, 1 \AOp:=v_signalao, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1 \Next, 1 \ProcID:=1, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1, 1;  ! -> RG311
        TriggEquip v_triggdata, 1, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggint
! rule: arguments of TriggInt
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR intnum v_intnum;
    PERS bool p_bool;
    PROC main()
        TriggInt v_triggdata, 1, v_intnum;
        TriggInt v_triggdata, 1 \Start, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggInt v_triggdata, 1 \Next, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggInt v_triggdata, 1 \Time, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggInt v_triggdata, 1;  ! -> RG311
        TriggInt v_triggdata, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggio
! rule: arguments of TriggIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    PERS num p_num;
    VAR signalgo v_signalgo;
    VAR signalao v_signalao;
    PROC main()
        TriggIO v_triggdata, 1, 1;
        TriggIO v_triggdata, 1 \Start \DOp:=v_signaldo, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1 \Next \GOp:=v_signalgo, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1 \Time \AOp:=v_signalao, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1 \Start \ProcID:=1, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1;  ! -> RG311
        TriggIO v_triggdata, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggj
! rule: arguments of TriggJ
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    VAR triggdata g;
    VAR triggdata a{3};
    PROC main()
        TriggJ p, v100, g, fine, tool0;
        TriggJ \Conc, p \ID:=1, v100 \T:=2, g \T2:=g \T3:=g \T4:=g \T5:=g \T6:=g \T7:=g \T8:=g, z10 \Inpos:=inpos50, tool0 \WObj:=w \TLoad:=l;
        TriggJ p, v100, a, fine, tool0;
        TriggJ p, v100, g, fine;  ! -> RG311
    ENDPROC
ENDMODULE
!=== triggl
! rule: arguments of TriggL
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    VAR triggdata g;
    VAR triggdata a{3};
    PROC main()
        TriggL p, v100, g, fine, tool0;
        TriggL \Conc, p \ID:=1, v100 \T:=2, g \T2:=g \T3:=g \T4:=g \T5:=g \T6:=g \T7:=g \T8:=g, z10 \Inpos:=inpos50, tool0 \WObj:=w \Corr \TLoad:=l;
        TriggL p, v100, a, fine, tool0;
        TriggL p, v100, g, fine;  ! -> RG311
    ENDPROC
ENDMODULE
!=== triggstopproc
! rule: arguments of TriggStopProc
! source: [manual] 3HAC050917
MODULE Demo
    PERS restartdata r;
    VAR signaldo s;
    VAR signalgo g;
    PROC main()
        TriggStopProc r, s;
        TriggStopProc r \DO1:=s \GO1:=g \GO2:=g \GO3:=g \GO4:=g, s;
        TriggStopProc r;  ! -> RG311
    ENDPROC
ENDMODULE
