! rule: named values: events
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := EVENT_NONE;
        n := EVENT_POWERON;
        n := EVENT_START;
        n := EVENT_STOP;
        n := EVENT_QSTOP;
        n := EVENT_RESTART;
        n := EVENT_RESET;
        n := EVENT_STEP;
        n := HANDLER_NONE;
        n := HANDLER_BWD;
        n := HANDLER_ERR;
        n := HANDLER_UNDO;
        n := LEVEL_NORMAL;
        n := LEVEL_TRAP;
        n := LEVEL_SERVICE;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
