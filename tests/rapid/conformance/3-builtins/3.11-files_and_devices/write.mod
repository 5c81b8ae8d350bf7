! rule: arguments of Write
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Write v_iodev, "x";
        Write v_iodev, "x" \Num:=1 \NoNewLine;
        Write v_iodev, "x" \Bool:=TRUE \NoNewLine;
        Write v_iodev, "x" \Pos:=[1, 2, 3] \NoNewLine;
        Write v_iodev, "x" \Orient:=[1, 0, 0, 0] \NoNewLine;
        Write v_iodev, "x" \Dnum:=1 \NoNewLine;
        Write v_iodev;  ! -> RG311
        Write v_iodev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
