! rule: arguments of SoftAct
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        SoftAct 1, 1;
        SoftAct \MechUnit:=v_mecunit, 1, 1 \Ramp:=1;
        SoftAct 1;  ! -> RG311
        SoftAct 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
