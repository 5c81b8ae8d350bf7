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
