! rule: arguments of SetAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    PROC main()
        SetAO v_signalao, 1;
        SetAO v_signalao;  ! -> RG311
        SetAO v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
