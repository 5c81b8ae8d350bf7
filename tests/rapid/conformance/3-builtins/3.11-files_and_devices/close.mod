! rule: arguments of Close
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Close v_iodev;
        Close;  ! -> RG311?
        Close v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
