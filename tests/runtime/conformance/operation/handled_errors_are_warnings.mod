MODULE handled_errors_are_warnings
    ! source: [K §7.5] the event log says so, unless SkipWarn was executed
    ! do: start, run 1
    ! log: 40199 error 1
    PROC main()
        fails 1;
        fails 2;
    ENDPROC
    PROC fails(num n)
        RAISE n;
    ERROR
        IF ERRNO = 2 SkipWarn;
        TRYNEXT;
    ENDPROC
ENDMODULE
