!=== waitai
! rule: arguments of WaitAI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalai v_signalai;
    VAR num v_num;
    VAR signaldo v_signaldo;
    VAR string v_string_array{2};
    PROC main()
        WaitAI v_signalai, 1;
        WaitAI v_signalai \LT, 1 \MaxTime:=1 \ValueAtTimeout:=v_num \Visualize \Header:="x" \Message:="x" \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitAI v_signalai \GT, 1 \MaxTime:=1 \ValueAtTimeout:=v_num \Visualize \Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitAI v_signalai;  ! -> RG311
        WaitAI v_signalai, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitao
! rule: arguments of WaitAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    VAR num v_num;
    VAR signaldo v_signaldo;
    VAR string v_string_array{2};
    PROC main()
        WaitAO v_signalao, 1;
        WaitAO v_signalao \LT, 1 \MaxTime:=1 \ValueAtTimeout:=v_num \Visualize \Header:="x" \Message:="x" \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitAO v_signalao \GT, 1 \MaxTime:=1 \ValueAtTimeout:=v_num \Visualize \Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitAO v_signalao;  ! -> RG311
        WaitAO v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitdi
! rule: arguments of WaitDI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldi v_signaldi;
    VAR bool v_bool;
    VAR signaldo v_signaldo;
    VAR string v_string_array{2};
    PROC main()
        WaitDI v_signaldi, 1;
        WaitDI v_signaldi, 1 \MaxTime:=1 \TimeFlag:=v_bool \Visualize \Header:="x" \Message:="x" \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitDI v_signaldi, 1 \MaxTime:=1 \TimeFlag:=v_bool \Visualize \Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitDI v_signaldi;  ! -> RG311
        WaitDI v_signaldi, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitdo
! rule: arguments of WaitDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    VAR bool v_bool;
    VAR string v_string_array{2};
    PROC main()
        WaitDO v_signaldo, 1;
        WaitDO v_signaldo, 1 \MaxTime:=1 \TimeFlag:=v_bool \Visualize \Header:="x" \Message:="x" \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitDO v_signaldo, 1 \MaxTime:=1 \TimeFlag:=v_bool \Visualize \Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitDO v_signaldo;  ! -> RG311
        WaitDO v_signaldo, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitgi
! rule: arguments of WaitGI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi s;
    VAR signaldo dout;
    VAR num n;
    VAR dnum d;
    PROC main()
        WaitGI s, 1;
        WaitGI s \NOTEQ, 1 \MaxTime:=1 \ValueAtTimeout:=n \Visualize \Header:="h" \Message:="m" \Wrap \Icon:=iconInfo \Image:="i" \VisualizeTime:=1 \UIActiveSignal:=dout;
        WaitGI s \LT, d \MaxTime:=1 \DvalueAtTimeout:=d;
        WaitGI s \GT, 1;
        WaitGI s;  ! -> RG311
        WaitGI s \LT \GT, 1;  ! -> RG313
    ENDPROC
ENDMODULE
!=== waitgo
! rule: arguments of WaitGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo s;
    VAR signaldo dout;
    VAR num n;
    VAR dnum d;
    PROC main()
        WaitGO s, 1;
        WaitGO s \NOTEQ, 1 \MaxTime:=1 \ValueAtTimeout:=n \Visualize \Header:="h" \Message:="m" \Wrap \Icon:=iconInfo \Image:="i" \VisualizeTime:=1 \UIActiveSignal:=dout;
        WaitGO s \LT, d \MaxTime:=1 \DvalueAtTimeout:=d;
        WaitGO s \GT, 1;
        WaitGO s;  ! -> RG311
        WaitGO s \LT \GT, 1;  ! -> RG313
    ENDPROC
ENDMODULE
!=== waitload
! rule: arguments of WaitLoad
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession v_loadsession;
    PROC main()
        WaitLoad v_loadsession;
        WaitLoad \UnloadPath:="x" \UnloadFile:="x", v_loadsession \CheckRef;
        WaitLoad;  ! -> RG311?
        WaitLoad v_loadsession \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitrob
! rule: arguments of WaitRob
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WaitRob;
        WaitRob \InPos;
        WaitRob \ZeroSpeed;
        WaitRob 1;  ! -> RG311
        WaitRob \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitsynctask
! rule: arguments of WaitSyncTask
! source: [manual] 3HAC050917
MODULE Demo
    VAR syncident v_syncident;
    PERS tasks p_tasks_array{2};
    PROC main()
        WaitSyncTask v_syncident, p_tasks_array;
        WaitSyncTask \InPos, v_syncident, p_tasks_array \TimeOut:=1;
        WaitSyncTask v_syncident;  ! -> RG311
        WaitSyncTask v_syncident, p_tasks_array \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waittestandset
! rule: arguments of WaitTestAndSet
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    PROC main()
        WaitTestAndSet p_bool;
        WaitTestAndSet;  ! -> RG311?
        WaitTestAndSet p_bool \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waittime
! rule: arguments of WaitTime
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WaitTime 1;
        WaitTime \InPos, 1;
        WaitTime;  ! -> RG311?
        WaitTime 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waituntil
! rule: arguments of WaitUntil
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR signaldo v_signaldo;
    VAR string v_string_array{2};
    PROC main()
        WaitUntil TRUE;
        WaitUntil \InPos, TRUE \MaxTime:=1 \TimeFlag:=v_bool \PollRate:=1 \Visualize \Header:="x" \Message:="x" \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitUntil \InPos, TRUE \MaxTime:=1 \TimeFlag:=v_bool \PollRate:=1 \Visualize \Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \Image:="x" \VisualizeTime:=1 \UIActiveSignal:=v_signaldo;
        WaitUntil;  ! -> RG311?
        WaitUntil TRUE \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
