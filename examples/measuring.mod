MODULE measuring
    CONST errnum NO_PLACE := 7;

    ! Called by clients, in the motion task: what it does is this module's affair.
    PROC measure(num place, INOUT num height)
        IF place < 1 THEN
            RAISE NO_PLACE;
        ENDIF
        WaitTime 0.1;
        height := 100 + place / 4;
    ERROR
        ! On to whoever has called.
        RAISE;
    ENDPROC
ENDMODULE
