! rule: arguments of STClose
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    PROC main()
        STClose v_string, v_num, v_num;
        STClose v_string, v_num, v_num \RetThickness:=v_num \Conc;
        STClose;  ! -> RG311?
    ENDPROC
ENDMODULE
