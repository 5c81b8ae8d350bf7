! rule: arguments of UnpackRawBytes
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes v_rawbytes;
    VAR num v_num;
    PROC main()
        UnpackRawBytes v_rawbytes, 1, v_num;
        UnpackRawBytes v_rawbytes \Network, 1, v_num \Hex1;
        UnpackRawBytes v_rawbytes \Network, 1, v_num \IntX:=1;
        UnpackRawBytes v_rawbytes \Network, 1, v_num \Float4;
        UnpackRawBytes v_rawbytes \Network, 1, v_num \ASCII:=1;
        UnpackRawBytes v_rawbytes, 1;  ! -> RG311
        UnpackRawBytes v_rawbytes, 1, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
