! rule: arguments of STCalcForce
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STCalcForce(v_string, v_num);
        result := STCalcForce();  ! -> RG311
    ENDPROC
ENDMODULE
