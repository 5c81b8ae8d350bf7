! rule: arguments of ReadBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num r_num;
    PROC main()
        r_num := ReadBin(v_iodev);
        r_num := ReadBin(v_iodev \Time:=1);
        r_num := ReadBin();  ! -> RG311
        r_num := ReadBin(v_iodev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
