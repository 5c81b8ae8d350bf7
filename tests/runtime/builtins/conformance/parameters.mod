MODULE parameters
    ! source: 3HAC16581-1 ReadCfgData: /DOMAIN/TYPE/INSTANCE [manual]; \ListNo [mem]
    ! signal: doLamp DO
    ! signal: diSwitch DI
    ! expect: DO
    ! expect: TRUE
    ! expect: not found
    ! expect: wrong type
    ! expect: doLamp 1
    ! expect: diSwitch -1
    ! expect: out of bounds
    ! expect: out of bounds
    ! expect: doLamp
    PROC main()
        VAR string text;
        VAR num upper;
        VAR num lower;
        ReadCfgData "/EIO/EIO_SIGNAL/doLamp", "SignalType", text;
        TPWrite text;
        ReadCfgData "/SYS/CAB_TASKS/T_ROB1", "Type", text;
        TPWrite ValToStr(text = "NORMAL");
        ReadCfgData "/EIO/EIO_SIGNAL/none", "SignalType", text;
        ReadCfgData "/EIO/EIO_SIGNAL/doLamp", "SignalType", upper;
        each;
    ERROR
        IF ERRNO = ERR_CFG_NOTFND TPWrite "not found";
        IF ERRNO = ERR_CFG_ILLTYPE TPWrite "wrong type";
        TRYNEXT;
    ENDPROC

    PROC each()
        VAR num number := 0;
        VAR string name;
        WHILE number >= 0 DO
            ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
            TPWrite name + " " + ValToStr(number);
        ENDWHILE
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
        number := 2;
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name;
        TPWrite name;
    ERROR
        IF ERRNO = ERR_CFG_OUTOFBND TPWrite "out of bounds";
        TRYNEXT;
    ENDPROC
ENDMODULE
