!=== bitand
! rule: arguments of BitAnd
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitAnd(1, 1);
        r_byte := BitAnd(1);  ! -> RG311
        r_byte := BitAnd(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== bitcheck
! rule: arguments of BitCheck
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := BitCheck(1, 1);
        r_bool := BitCheck(1);  ! -> RG311
        r_bool := BitCheck(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== bitclear
! rule: arguments of BitClear
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte b;
    VAR dnum d;
    PROC main()
        BitClear b, 1;
        BitClear d, 52;
        BitClear b;  ! -> RG311
        BitClear 1, 1;  ! -> RG315
    ENDPROC
ENDMODULE
!=== bitlsh
! rule: arguments of BitLSh
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitLSh(1, 1);
        r_byte := BitLSh(1);  ! -> RG311
        r_byte := BitLSh(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== bitneg
! rule: arguments of BitNeg
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitNeg(1);
        r_byte := BitNeg();  ! -> RG311
        r_byte := BitNeg(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== bitor
! rule: arguments of BitOr
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitOr(1, 1);
        r_byte := BitOr(1);  ! -> RG311
        r_byte := BitOr(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== bitrsh
! rule: arguments of BitRSh
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitRSh(1, 1);
        r_byte := BitRSh(1);  ! -> RG311
        r_byte := BitRSh(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== bitset
! rule: arguments of BitSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR byte v_byte;
    PROC main()
        BitSet v_byte, 1;
        BitSet v_dnum, 1;
        BitSet v_byte;  ! -> RG311
        BitSet v_byte, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== bitxor
! rule: arguments of BitXOr
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitXOr(1, 1);
        r_byte := BitXOr(1);  ! -> RG311
        r_byte := BitXOr(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== clearrawbytes
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
!=== copyrawbytes
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
!=== packdnheader
! rule: arguments of PackDNHeader
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes v_rawbytes;
    PROC main()
        PackDNHeader "x", "x", v_rawbytes;
        PackDNHeader "x", "x";  ! -> RG311
        PackDNHeader "x", "x", v_rawbytes \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== packrawbytes
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
!=== rawbyteslen
! rule: arguments of RawBytesLen
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes v_rawbytes;
    VAR num r_num;
    PROC main()
        r_num := RawBytesLen(v_rawbytes);
        r_num := RawBytesLen();  ! -> RG311
        r_num := RawBytesLen(v_rawbytes \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== readrawbytes
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
!=== unpackrawbytes
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
!=== writerawbytes
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
