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
