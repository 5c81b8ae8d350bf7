! rule: arguments of IError
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        IError 1, 1, v_intnum;
        IError 1 \ErrorId:=1, 1, v_intnum;
        IError 1, 1;  ! -> RG311
        IError 1, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
