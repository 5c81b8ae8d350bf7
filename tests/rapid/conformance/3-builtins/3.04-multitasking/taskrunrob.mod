! rule: arguments of TaskRunRob
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := TaskRunRob();
        r_bool := TaskRunRob(1);  ! -> RG311
        r_bool := TaskRunRob(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
