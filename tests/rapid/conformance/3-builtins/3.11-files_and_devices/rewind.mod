! rule: arguments of Rewind
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Rewind v_iodev;
        Rewind;  ! -> RG311?
        Rewind v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
