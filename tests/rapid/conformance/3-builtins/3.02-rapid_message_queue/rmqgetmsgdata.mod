! rule: arguments of RMQGetMsgData
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqmessage v_rmqmessage;
    VAR num v_num;
    PROC main()
        RMQGetMsgData v_rmqmessage, v_num;
        RMQGetMsgData v_rmqmessage;  ! -> RG311
        RMQGetMsgData v_rmqmessage, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
