! rule: arguments of MotionSup
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        MotionSup;
        MotionSup \On \Tunevalue:=1 \NoBackoff;
        MotionSup \Off \Tunevalue:=1 \NoBackoff;
        MotionSup 1;  ! -> RG311
        MotionSup \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
