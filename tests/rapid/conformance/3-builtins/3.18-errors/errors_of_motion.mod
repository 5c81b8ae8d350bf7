! rule: names of errors: motion
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_PATH_STOP;
        e := ERR_COLL_STOP;
        e := ERR_PATHDIST;
        e := ERR_STARTMOVE;
        e := ERR_PROGSTOP;
        e := ERR_ALRDY_MOVING;
        e := ERR_ROBLIMIT;
        e := ERR_OUTSIDE_REACH;
        e := ERR_CONC_MAX;
        e := ERR_WHLSEARCH;
        e := ERR_SIGSUPSEARCH;
        e := ERR_PERSSUPSEARCH;
        e := ERR_SPEED_REFRESH_LIM;
        e := ERR_SPEEDLIM_VALUE;
        e := ERR_SYNCMOVEON;
        e := ERR_SYNCMOVEOFF;
        e := ERR_AXIS_ACT;
        e := ERR_AXIS_IND;
        e := ERR_AXIS_PAR;
        e := ERR_AXIS_MOVING;
        e := ERR_UNIT_PAR;
        e := ERR_UDPUC_COMM;
    ENDPROC
ENDMODULE
