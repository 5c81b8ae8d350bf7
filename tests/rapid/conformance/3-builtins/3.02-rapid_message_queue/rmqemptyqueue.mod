! rule: arguments of RMQEmptyQueue
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RMQEmptyQueue;
        RMQEmptyQueue 1;  ! -> RG311
        RMQEmptyQueue \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
