! rule: arguments of GetMotorTorque
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR mecunit v_mecunit;
    PROC main()
        r_num := GetMotorTorque(1);
        r_num := GetMotorTorque(\MecUnit:=v_mecunit, 1);
        r_num := GetMotorTorque();  ! -> RG311
        r_num := GetMotorTorque(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
