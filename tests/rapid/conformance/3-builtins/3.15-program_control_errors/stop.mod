! rule: arguments of Stop
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        Stop;
        Stop \NoRegain;
        Stop \AllMoveTasks;
        Stop 1;  ! -> RG311
        Stop \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
