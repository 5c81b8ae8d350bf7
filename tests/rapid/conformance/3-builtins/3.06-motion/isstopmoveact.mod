! rule: arguments of IsStopMoveAct
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsStopMoveAct();
        r_bool := IsStopMoveAct(\FromMoveTask);
        r_bool := IsStopMoveAct(\FromNonMoveTask);
        r_bool := IsStopMoveAct(1);  ! -> RG311
        r_bool := IsStopMoveAct(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
