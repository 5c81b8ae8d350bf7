! rule: names of errors: values
! source: [code] rapid-for-vim; [K §12]
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_DIVZERO;
        e := ERR_CALC_DIVZERO;
        e := ERR_CALC_NEG;
        e := ERR_CALC_OVERFLOW;
        e := ERR_OVERFLOW;
        e := ERR_NUM_LIMIT;
        e := ERR_INT_NOTVAL;
        e := ERR_INT_MAXVAL;
        e := ERR_MAXINTVAL;
        e := ERR_NOTINTVAL;
        e := ERR_NEGARG;
        e := ERR_ARGVALERR;
        e := ERR_STRTOOLNG;
        e := ERR_ILLQUAT;
        e := ERR_LIM_VALUE;
    ENDPROC
ENDMODULE
