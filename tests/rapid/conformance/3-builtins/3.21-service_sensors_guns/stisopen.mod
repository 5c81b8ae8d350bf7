! rule: arguments of STIsOpen
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STIsOpen(v_string);
        result := STIsOpen(v_string \RetTipWear:=v_num \RetPosAdj:=v_num);
        result := STIsOpen();  ! -> RG311
    ENDPROC
ENDMODULE
