! rule: arguments of TaskRunMec
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := TaskRunMec();
        r_bool := TaskRunMec(1);  ! -> RG311
        r_bool := TaskRunMec(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
