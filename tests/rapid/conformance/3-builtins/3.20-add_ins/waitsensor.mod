! rule: arguments of WaitSensor
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR mecunit v_mecunit;
    PROC main()
        WaitSensor v_mecunit;
        WaitSensor v_mecunit \RelDist:=1 \PredTime:=1 \MaxTime:=1 \TimeFlag:=v_bool;
        WaitSensor;  ! -> RG311?
        WaitSensor v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
