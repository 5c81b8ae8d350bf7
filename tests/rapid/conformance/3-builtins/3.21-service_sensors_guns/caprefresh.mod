! rule: arguments of CapRefresh
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR num v_num;
    PROC main()
        CapRefresh;
        CapRefresh \MainSpeed \MainWeave \Startweave:=v_bool \RestartDist:=v_num;
        CapRefresh 1;  ! -> RG311?
    ENDPROC
ENDMODULE
