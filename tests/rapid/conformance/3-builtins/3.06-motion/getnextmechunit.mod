! rule: arguments of GetNextMechUnit
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    VAR bool r_bool;
    VAR mecunit v_mecunit;
    VAR bool v_bool;
    PROC main()
        r_bool := GetNextMechUnit(v_num, v_string);
        r_bool := GetNextMechUnit(v_num, v_string \MecRef:=v_mecunit \TCPRob:=v_bool \NoOfAxes:=v_num \MecTaskNo:=v_num \MotPlanNo:=v_num \Active:=v_bool \DriveModule:=v_num \OKToDeact:=v_bool);
        r_bool := GetNextMechUnit(v_num);  ! -> RG311
        r_bool := GetNextMechUnit(v_num, v_string \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
