! rule: arguments of SetGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    PROC main()
        SetGO v_signalgo, 1;
        SetGO \SDelay:=1, v_signalgo, 1;
        SetGO v_signalgo;  ! -> RG311
        SetGO v_signalgo, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
