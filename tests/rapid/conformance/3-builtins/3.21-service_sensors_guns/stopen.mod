! rule: arguments of STOpen
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        STOpen v_string;
        STOpen v_string \WaitZeroSpeed \Conc;
        STOpen;  ! -> RG311?
    ENDPROC
ENDMODULE
