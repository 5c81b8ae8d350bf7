MODULE parameters
    ! source: 3HAC16581-1 ReadCfgData: /DOMAIN/TYPE/INSTANCE [manual]
    ! signal: doLamp DO
    ! expect: DO
    ! expect: TRUE
    ! expect: not found
    ! expect: wrong type
    PROC main()
        VAR string text;
        VAR num upper;
        VAR num lower;
        ReadCfgData "/EIO/EIO_SIGNAL/doLamp", "SignalType", text;
        TPWrite text;
        ReadCfgData "/SYS/CAB_TASKS/T_ROB1", "Entry", text;
        TPWrite ValToStr(text = "main");
        ReadCfgData "/EIO/EIO_SIGNAL/none", "SignalType", text;
        ReadCfgData "/EIO/EIO_SIGNAL/doLamp", "SignalType", upper;
    ERROR
        IF ERRNO = ERR_CFG_NOTFND TPWrite "not found";
        IF ERRNO = ERR_CFG_ILLTYPE TPWrite "wrong type";
        TRYNEXT;
    ENDPROC
ENDMODULE
