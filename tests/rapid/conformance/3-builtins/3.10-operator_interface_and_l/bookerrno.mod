! rule: arguments of BookErrNo
! source: [manual] 3HAC050917
MODULE Demo
    VAR errnum v_errnum;
    PROC main()
        BookErrNo v_errnum;
        BookErrNo;  ! -> RG311?
        BookErrNo v_errnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
