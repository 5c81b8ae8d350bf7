! rule: arguments of RobOS
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := RobOS();
        r_bool := RobOS(1);  ! -> RG311
        r_bool := RobOS(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
