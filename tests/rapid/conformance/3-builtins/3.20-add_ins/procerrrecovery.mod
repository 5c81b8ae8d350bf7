! rule: arguments of ProcerrRecovery
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        ProcerrRecovery;
        ProcerrRecovery \SyncOrgMoveInst \ProcSignal:=v_signaldo;
        ProcerrRecovery \SyncLastMoveInst \ProcSignal:=v_signaldo;
        ProcerrRecovery \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
