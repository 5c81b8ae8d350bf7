! rule: arguments of CopyRawBytes
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes v_rawbytes;
    PROC main()
        CopyRawBytes v_rawbytes, 1, v_rawbytes, 1;
        CopyRawBytes v_rawbytes, 1, v_rawbytes, 1 \NoOfBytes:=1;
        CopyRawBytes v_rawbytes, 1, v_rawbytes;  ! -> RG311
        CopyRawBytes v_rawbytes, 1, v_rawbytes, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
