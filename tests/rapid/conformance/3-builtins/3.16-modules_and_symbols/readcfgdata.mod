! rule: arguments of ReadCfgData
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        ReadCfgData "x", "x", v_num;
        ReadCfgData "x", "x", v_num \ListNo:=v_num;
        ReadCfgData "x", "x";  ! -> RG311
        ReadCfgData "x", "x", v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
