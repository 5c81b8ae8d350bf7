! rule: arguments of RMQSendWait
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot v_rmqslot;
    VAR num v_num;
    VAR rmqmessage v_rmqmessage;
    PROC main()
        RMQSendWait v_rmqslot, v_num, v_rmqmessage, v_num;
        RMQSendWait v_rmqslot, v_num \UserDef:=1, v_rmqmessage, v_num \TimeOut:=1;
        RMQSendWait v_rmqslot, v_num, v_rmqmessage;  ! -> RG311
        RMQSendWait v_rmqslot, v_num, v_rmqmessage, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
