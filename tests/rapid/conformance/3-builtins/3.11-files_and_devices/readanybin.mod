! rule: arguments of ReadAnyBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num v_num;
    PROC main()
        ReadAnyBin v_iodev, v_num;
        ReadAnyBin v_iodev, v_num \Time:=1;
        ReadAnyBin v_iodev;  ! -> RG311
        ReadAnyBin v_iodev, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
