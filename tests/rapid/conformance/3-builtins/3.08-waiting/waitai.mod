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
