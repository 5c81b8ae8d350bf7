! rule: arguments of RMQGetMsgHeader
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqmessage v_rmqmessage;
    VAR rmqheader v_rmqheader;
    VAR rmqslot v_rmqslot;
    VAR num v_num;
    PROC main()
        RMQGetMsgHeader v_rmqmessage;
        RMQGetMsgHeader v_rmqmessage \Header:=v_rmqheader \SenderId:=v_rmqslot \UserDef:=v_num;
        RMQGetMsgHeader;  ! -> RG311?
        RMQGetMsgHeader v_rmqmessage \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
