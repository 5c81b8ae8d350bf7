! rule: arguments of FricIdEvaluate
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num_2{2};
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR speeddata v_speeddata;
    PROC main()
        FricIdEvaluate p_num_2;
        FricIdEvaluate p_num_2 \MechUnit:=v_mecunit \BwdSpeed:=v_speeddata \NoPrint \FricLevelMax:=v_num \FricLevelMin:=v_num \OptTolerance:=v_num;
        FricIdEvaluate;  ! -> RG311?
    ENDPROC
ENDMODULE
