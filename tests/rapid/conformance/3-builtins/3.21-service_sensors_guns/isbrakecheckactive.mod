! rule: arguments of IsBrakeCheckActive
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    PROC main()
        result := IsBrakeCheckActive();
        result := IsBrakeCheckActive(1);  ! -> RG311?
    ENDPROC
ENDMODULE
