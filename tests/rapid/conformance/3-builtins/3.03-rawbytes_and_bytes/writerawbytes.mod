! rule: arguments of WriteRawBytes
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR rawbytes v_rawbytes;
    PROC main()
        WriteRawBytes v_iodev, v_rawbytes;
        WriteRawBytes v_iodev, v_rawbytes \NoOfBytes:=1;
        WriteRawBytes v_iodev;  ! -> RG311
        WriteRawBytes v_iodev, v_rawbytes \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
