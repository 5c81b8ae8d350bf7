! rule: arguments of RMQSendMessage
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot v_rmqslot;
    VAR num v_num;
    PROC main()
        RMQSendMessage v_rmqslot, v_num;
        RMQSendMessage v_rmqslot, v_num \UserDef:=1;
        RMQSendMessage v_rmqslot;  ! -> RG311
        RMQSendMessage v_rmqslot, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
