! rule: arguments of MotionProcessModeSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR motionprocessmode v_motionprocessmode;
    PROC main()
        MotionProcessModeSet v_motionprocessmode;
        MotionProcessModeSet;  ! -> RG311?
    ENDPROC
ENDMODULE
