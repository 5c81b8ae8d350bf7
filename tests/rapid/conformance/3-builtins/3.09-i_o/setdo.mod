! rule: arguments of SetDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        SetDO v_signaldo, 1;
        SetDO \SDelay:=1, v_signaldo, 1;
        SetDO \Sync, v_signaldo, 1;
        SetDO v_signaldo;  ! -> RG311
        SetDO v_signaldo, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
