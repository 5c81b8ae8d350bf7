MODULE list_from_one
    ! source: [mem] the other answer about \ListNo: from 1, 0 follows the last
    ! dialect: list_number=one
    ! signal: doLamp DO
    ! signal: diSwitch DI
    ! expect: doLamp 2
    ! expect: diSwitch 0
    ! expect: out of bounds
    PROC main()
        VAR num number := 1;
        VAR string name;
        WHILE number > 0 DO
            ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
            TPWrite name + " " + ValToStr(number);
        ENDWHILE
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
    ERROR
        IF ERRNO = ERR_CFG_OUTOFBND TPWrite "out of bounds";
        TRYNEXT;
    ENDPROC
ENDMODULE
