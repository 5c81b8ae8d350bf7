! rule: arguments of NonMotionMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR symnum r_symnum;
    PROC main()
        r_symnum := NonMotionMode();
        r_symnum := NonMotionMode(\Main);
        r_symnum := NonMotionMode(1);  ! -> RG311
        r_symnum := NonMotionMode(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
