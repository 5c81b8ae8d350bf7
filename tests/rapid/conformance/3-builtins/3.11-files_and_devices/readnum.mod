! rule: arguments of ReadNum
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num r_num;
    PROC main()
        r_num := ReadNum(v_iodev);
        r_num := ReadNum(v_iodev \Delim:="x" \Time:=1);
        r_num := ReadNum();  ! -> RG311
        r_num := ReadNum(v_iodev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
