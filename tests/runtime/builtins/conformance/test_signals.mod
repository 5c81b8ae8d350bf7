MODULE test_signals
    ! source: gizatt/ABB-IRB140 [code]: a force sensor's signals on twelve channels
    ! robot: irb120
    ! expect: channel
    ! expect: 0
    ! expect: channel
    ! expect: axis
    ! expect: no signal
    ! fault: 49905 14
    PROC main()
        each;
        TestSignReset;
        TPWrite ValToStr(TestSignRead(3));
        TestSignDefine 1, 6, ROB_1, 1, 0;
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "no signal";
        TRYNEXT;
    ENDPROC

    PROC each()
        TPWrite ValToStr(TestSignRead(3));
        TestSignDefine 3, 203, ROB_1, 1, 0;
        TPWrite ValToStr(TestSignRead(3));
        TestSignDefine 13, 203, ROB_1, 1, 0;
        TestSignDefine 3, 9, ROB_1, 7, 0;
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "channel";
        IF ERRNO = ERR_AXIS_PAR TPWrite "axis";
        TRYNEXT;
    ENDPROC
ENDMODULE
