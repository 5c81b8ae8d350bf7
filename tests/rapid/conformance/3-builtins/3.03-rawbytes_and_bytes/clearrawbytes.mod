! rule: arguments of ClearRawBytes
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes v_rawbytes;
    PROC main()
        ClearRawBytes v_rawbytes;
        ClearRawBytes v_rawbytes \FromIndex:=1;
        ClearRawBytes;  ! -> RG311?
        ClearRawBytes v_rawbytes \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
