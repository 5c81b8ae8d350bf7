MODULE hands_calibrated
    ! source: [code] HandDriver.sys asks for a calibration; one by a program before is a switch (`hands_calibrated`)
    ! case: hands_calibrated=false
    ! expect: not calibrated
    ! case: hands_calibrated=true
    ! expect: 10
    PROC main()
        g_MoveTo 10;
        TPWrite ValToStr(g_GetPos());
    ERROR
        IF ERRNO = ERR_HAND_NOTCALIBRATED TPWrite "not calibrated";
        RETURN;
    ENDPROC
ENDMODULE
