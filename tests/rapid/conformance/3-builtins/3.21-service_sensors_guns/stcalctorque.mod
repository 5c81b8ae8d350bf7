! rule: arguments of STCalcTorque
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STCalcTorque(v_string, v_num);
        result := STCalcTorque();  ! -> RG311
    ENDPROC
ENDMODULE
