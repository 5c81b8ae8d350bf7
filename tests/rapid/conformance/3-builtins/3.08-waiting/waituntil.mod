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
