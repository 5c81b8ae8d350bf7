! rule: arguments of STIsCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR string v_string;
    PROC main()
        result := STIsCalib(v_string);
        result := STIsCalib(v_string \sguninit);
        result := STIsCalib();  ! -> RG311
    ENDPROC
ENDMODULE
