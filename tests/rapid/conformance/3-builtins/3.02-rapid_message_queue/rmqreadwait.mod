! rule: arguments of RMQReadWait
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqmessage v_rmqmessage;
    PROC main()
        RMQReadWait v_rmqmessage;
        RMQReadWait v_rmqmessage \TimeOut:=1;
        RMQReadWait;  ! -> RG311?
        RMQReadWait v_rmqmessage \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
