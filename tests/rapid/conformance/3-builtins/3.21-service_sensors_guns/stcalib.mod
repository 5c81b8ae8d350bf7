! rule: arguments of STCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    PROC main()
        STCalib v_string;
        STCalib v_string \ToolChg \RetTipWear:=v_num \RetPosAdj:=v_num \PrePos:=v_num \Conc;
        STCalib;  ! -> RG311?
    ENDPROC
ENDMODULE
