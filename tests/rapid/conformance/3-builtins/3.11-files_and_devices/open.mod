! rule: arguments of Open
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Open "x", v_iodev;
        Open "x" \File:="x", v_iodev \Read \Bin;
        Open "x" \File:="x", v_iodev \Write \Bin;
        Open "x" \File:="x", v_iodev \Append \Bin;
        Open "x";  ! -> RG311
        Open "x", v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
