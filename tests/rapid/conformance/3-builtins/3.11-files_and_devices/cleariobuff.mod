! rule: arguments of ClearIOBuff
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        ClearIOBuff v_iodev;
        ClearIOBuff;  ! -> RG311?
        ClearIOBuff v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
