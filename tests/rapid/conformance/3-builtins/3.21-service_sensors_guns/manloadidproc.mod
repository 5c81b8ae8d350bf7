! rule: arguments of ManLoadIdProc
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR loaddata v_loaddata;
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR paridnum v_paridnum;
    PROC main()
        ManLoadIdProc;
        ManLoadIdProc \ParIdType:=v_paridnum \MechUnit:=v_mecunit \AxisNumber:=v_num \PayLoad:=v_loaddata \ConfigAngle:=v_num \DeactAll \DefinedFlag:=v_bool \DoExit:=v_bool;
        ManLoadIdProc 1;  ! -> RG311?
    ENDPROC
ENDMODULE
