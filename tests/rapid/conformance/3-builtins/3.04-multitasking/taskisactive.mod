! rule: arguments of TaskIsActive
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    VAR bool r_bool;
    PROC main()
        r_bool := TaskIsActive(v_taskid);
        r_bool := TaskIsActive("x");
        r_bool := TaskIsActive();  ! -> RG311
        r_bool := TaskIsActive(v_taskid \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
