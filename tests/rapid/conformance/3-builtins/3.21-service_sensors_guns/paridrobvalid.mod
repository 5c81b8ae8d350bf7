! rule: arguments of ParIdRobValid
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR paridnum v_paridnum;
    VAR paridvalidnum result;
    PROC main()
        result := ParIdRobValid(v_paridnum);
        result := ParIdRobValid(v_paridnum \MechUnit:=v_mecunit \AxisNo:=v_num);
        result := ParIdRobValid();  ! -> RG311
    ENDPROC
ENDMODULE
