MODULE queues
    ! source: 3HAC16581-1 RAPID message queue [manual]; limits and defaults [mem]
    ! task: T_OTHER other
    ! expect: ERR_RMQ_NAME
    ! expect: trap [1,2,3] 7
    ! expect: answer from RMQ_T_OTHER: 42
    ! expect: ERR_RMQ_FULL
    ! expect: num 0
    ! expect: ERR_RMQ_VALUE
    ! expect: ERR_RMQ_TIMEOUT
    ! expect: ERR_RMQ_NOMSG
    VAR intnum arrived;
    VAR rmqslot partner;

    PROC main()
        VAR rmqmessage message;
        VAR rmqheader header;
        VAR rmqslot sender;
        VAR pos p := [1,2,3];
        VAR num answer;
        VAR num wanted;
        WaitTime 0.1;
        RMQFindSlot partner, "RMQ_nobody";
        RMQFindSlot partner, "RMQ_T_OTHER";
        RMQSendMessage partner, p \UserDef:=7;
        WaitTime 0.5;
        RMQSendWait partner, TRUE, message, wanted \TimeOut:=5;
        RMQGetMsgData message, answer;
        RMQGetMsgHeader message \SenderId:=sender;
        TPWrite "answer from " + RMQGetSlotName(sender) + ": " + ValToStr(answer);
        RMQFindSlot partner, "RMQ_T_ROB1";
        FOR i FROM 1 TO 6 DO
            RMQSendMessage partner, i;
        ENDFOR
        RMQReadWait message;
        RMQGetMsgHeader message \Header:=header;
        TPWrite header.datatype + " " + ValToStr(header.ndim);
        RMQGetMsgData message, p;
        RMQEmptyQueue;
        RMQReadWait message \TimeOut:=0.2;
        RMQGetMessage message;
    ERROR
        TEST ERRNO
        CASE ERR_RMQ_NAME:
            TPWrite "ERR_RMQ_NAME";
        CASE ERR_RMQ_FULL:
            TPWrite "ERR_RMQ_FULL";
        CASE ERR_RMQ_VALUE:
            TPWrite "ERR_RMQ_VALUE";
        CASE ERR_RMQ_TIMEOUT:
            TPWrite "ERR_RMQ_TIMEOUT";
        CASE ERR_RMQ_NOMSG:
            TPWrite "ERR_RMQ_NOMSG";
        ENDTEST
        TRYNEXT;
    ENDPROC

    PROC other()
        VAR pos p;
        VAR rmqmessage message;
        VAR rmqslot sender;
        CONNECT arrived WITH on_pos;
        IRMQMessage p, arrived;
        WaitTime 0.4;
        RMQReadWait message;
        RMQGetMsgHeader message \SenderId:=sender;
        RMQSendMessage sender, 42;
    ENDPROC

    TRAP on_pos
        VAR rmqmessage message;
        VAR pos p;
        VAR num user;
        RMQGetMessage message;
        RMQGetMsgData message, p;
        RMQGetMsgHeader message \UserDef:=user;
        TPWrite "trap " + ValToStr(p) + " " + ValToStr(user);
    ENDTRAP
ENDMODULE
