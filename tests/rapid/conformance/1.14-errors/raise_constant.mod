! rule: RAISE takes a constant or a booked number
! source: [K §7.1] [code] abb_driver
MODULE Demo
    CONST errnum MY_ERROR := 17;
    VAR bool a;
    PROC main()
        IF a RAISE ERR_ARGVALERR;
        RAISE MY_ERROR;
    ENDPROC
ENDMODULE
