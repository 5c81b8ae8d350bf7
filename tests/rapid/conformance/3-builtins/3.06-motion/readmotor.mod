! rule: arguments of ReadMotor
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR mecunit v_mecunit;
    PROC main()
        r_num := ReadMotor(1);
        r_num := ReadMotor(\MecUnit:=v_mecunit, 1);
        r_num := ReadMotor();  ! -> RG311
        r_num := ReadMotor(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
