! rule: arguments of ReadStrBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR string r_string;
    PROC main()
        r_string := ReadStrBin(v_iodev, 1);
        r_string := ReadStrBin(v_iodev, 1 \Time:=1);
        r_string := ReadStrBin(v_iodev);  ! -> RG311
        r_string := ReadStrBin(v_iodev, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
