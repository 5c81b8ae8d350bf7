! rule: arguments of DropSensor
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        DropSensor v_mecunit;
        DropSensor;  ! -> RG311?
        DropSensor v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
