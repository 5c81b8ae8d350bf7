! rule: arguments of WriteAnyBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        WriteAnyBin v_iodev, 1;
        WriteAnyBin v_iodev;  ! -> RG311
        WriteAnyBin v_iodev, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
