! rule: arguments of ReadRawBytes
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR rawbytes v_rawbytes;
    PROC main()
        ReadRawBytes v_iodev, v_rawbytes;
        ReadRawBytes v_iodev, v_rawbytes \Time:=1;
        ReadRawBytes v_iodev;  ! -> RG311
        ReadRawBytes v_iodev, v_rawbytes \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
