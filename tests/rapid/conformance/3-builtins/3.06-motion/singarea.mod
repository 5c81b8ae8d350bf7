! rule: arguments of SingArea
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SingArea;
        SingArea \Wrist;
        SingArea \LockAxis4;
        SingArea \Off;
        SingArea 1;  ! -> RG311
        SingArea \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
