! rule: arguments of SetupCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    PROC main()
        SetupCyclicBool p_bool, TRUE;
        SetupCyclicBool p_bool, TRUE \Signal:=v_signaldo;
        SetupCyclicBool;  ! -> RG311?
        SetupCyclicBool p_bool, TRUE \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
