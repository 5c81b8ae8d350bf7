!=== irmqmessage
! rule: arguments of IRMQMessage
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR intnum v_intnum;
    PROC main()
        IRMQMessage v_num, v_intnum;
        IRMQMessage v_num;  ! -> RG311
        IRMQMessage v_num, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== rmqemptyqueue
! rule: arguments of RMQEmptyQueue
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RMQEmptyQueue;
        RMQEmptyQueue 1;  ! -> RG311
        RMQEmptyQueue \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== rmqfindslot
! rule: arguments of RMQFindSlot
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot v_rmqslot;
    PROC main()
        RMQFindSlot v_rmqslot, "x";
        RMQFindSlot v_rmqslot;  ! -> RG311
        RMQFindSlot v_rmqslot, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== rmqgetmessage
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
!=== rmqgetmsgdata
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
!=== rmqgetmsgheader
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
!=== rmqgetslotname
! rule: arguments of RMQGetSlotName
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot v_rmqslot;
    VAR string r_string;
    PROC main()
        r_string := RMQGetSlotName(v_rmqslot);
        r_string := RMQGetSlotName();  ! -> RG311
        r_string := RMQGetSlotName(v_rmqslot \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== rmqreadwait
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
!=== rmqsendmessage
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
!=== rmqsendwait
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
