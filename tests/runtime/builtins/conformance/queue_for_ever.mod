MODULE queue_for_ever
    ! source: [mem] RMQSendWait without \TimeOut
    ! dialect: queue_patience=false
    ! task: T_OTHER other
    ! expect: answered after 90
    VAR clock watch;
    PROC main()
        VAR rmqslot partner;
        VAR rmqmessage message;
        VAR num wanted;
        RMQFindSlot partner, "RMQ_T_OTHER";
        ClkStart watch;
        RMQSendWait partner, TRUE, message, wanted;
        TPWrite "answered after " \Num:=Round(ClkRead(watch));
    ERROR
        IF ERRNO = ERR_RMQ_TIMEOUT TPWrite ValToStr(Round(ClkRead(watch)));
        RETURN;
    ENDPROC

    PROC other()
        VAR rmqmessage message;
        VAR rmqslot sender;
        RMQReadWait message;
        RMQGetMsgHeader message \SenderId:=sender;
        WaitTime 90;
        RMQSendMessage sender, 42;
    ENDPROC
ENDMODULE
