! rule: arguments of WriteStrBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        WriteStrBin v_iodev, "x";
        WriteStrBin v_iodev;  ! -> RG311
        WriteStrBin v_iodev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
