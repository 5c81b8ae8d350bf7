! rule: arguments of MaxRobSpeed
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := MaxRobSpeed();
        r_num := MaxRobSpeed(1);  ! -> RG311
        r_num := MaxRobSpeed(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
