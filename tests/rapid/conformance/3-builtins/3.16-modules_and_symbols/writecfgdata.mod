! rule: arguments of WriteCfgData
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        WriteCfgData "x", "x", 1;
        WriteCfgData "x", "x", 1 \ListNo:=v_num;
        WriteCfgData "x", "x";  ! -> RG311
        WriteCfgData "x", "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
