! rule: arguments of MotionPlannerNo
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := MotionPlannerNo();
        r_num := MotionPlannerNo(1);  ! -> RG311
        r_num := MotionPlannerNo(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
