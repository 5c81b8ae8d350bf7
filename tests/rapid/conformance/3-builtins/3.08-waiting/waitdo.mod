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
