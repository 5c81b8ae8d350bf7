! rule: arguments of PackRawBytes
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes v_rawbytes;
    PROC main()
        PackRawBytes 1, v_rawbytes, 1;
        PackRawBytes 1, v_rawbytes \Network, 1 \Hex1;
        PackRawBytes 1, v_rawbytes \Network, 1 \IntX:=1;
        PackRawBytes 1, v_rawbytes \Network, 1 \Float4;
        PackRawBytes 1, v_rawbytes \Network, 1 \ASCII;
        PackRawBytes 1, v_rawbytes;  ! -> RG311
        PackRawBytes 1, v_rawbytes, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
