! rule: arguments of TaskIsExecuting
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    VAR bool r_bool;
    PROC main()
        r_bool := TaskIsExecuting(v_taskid);
        r_bool := TaskIsExecuting("x");
        r_bool := TaskIsExecuting();  ! -> RG311
        r_bool := TaskIsExecuting(v_taskid \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
