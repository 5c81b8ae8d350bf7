! rule: arguments of RMQGetMessage
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqmessage v_rmqmessage;
    PROC main()
        RMQGetMessage v_rmqmessage;
        RMQGetMessage;  ! -> RG311?
        RMQGetMessage v_rmqmessage \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
