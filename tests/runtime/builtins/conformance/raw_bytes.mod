MODULE raw_bytes
    ! source: [manual] 3HAC16581-1 PackRawBytes to RawBytesLen; [code] abb_driver
    ! expect: 8
    ! expect: 4 104
    ! expect: 1.5
    ! expect: -3
    ! expect: hello
    ! expect: 6
    ! expect: 65534
    ! expect: beyond
    ! expect: not whole
    ! expect: 0
    RECORD message
        num kind;
        rawbytes body;
    ENDRECORD
    VAR message kept;

    PROC main()
        VAR rawbytes raw;
        VAR rawbytes copy;
        VAR num n;
        VAR byte b;
        VAR string s;
        PackRawBytes 1.5, raw, 5 \Float4;
        TPWrite ValToStr(RawBytesLen(raw));
        PackRawBytes 104, raw, 4, \Hex1;
        UnpackRawBytes raw, 4, b \Hex1;
        TPWrite "4 " + ValToStr(b);
        UnpackRawBytes raw, 5, n \Float4;
        TPWrite ValToStr(n);
        PackRawBytes -3, raw \Network, 1 \IntX:=INT;
        UnpackRawBytes raw \Network, 1, n \IntX:=INT;
        TPWrite ValToStr(n);
        ClearRawBytes raw;
        PackRawBytes "hello", raw, 1 \ASCII;
        CopyRawBytes raw, 1, kept.body, 2;
        UnpackRawBytes kept.body, 2, s \ASCII:=5;
        TPWrite s;
        TPWrite ValToStr(RawBytesLen(kept.body));
        PackRawBytes 65534, copy, 1 \IntX:=UINT;
        UnpackRawBytes copy, 1, n \IntX:=UINT;
        TPWrite ValToStr(n);
        UnpackRawBytes copy, 1, n \IntX:=DINT;
        PackRawBytes 0.5, copy, 1 \IntX:=DINT;
        fresh;
    ERROR
        TEST ERRNO
        CASE ERR_OUTOFBND:
            TPWrite "beyond";
        CASE ERR_INT_NOTVAL:
            TPWrite "not whole";
        ENDTEST
        TRYNEXT;
    ENDPROC

    PROC fresh()
        VAR rawbytes own;
        TPWrite ValToStr(RawBytesLen(own));
        PackRawBytes 1, own, 1 \IntX:=DINT;
        IF kept.kind < 1 THEN
            kept.kind := kept.kind + 1;
        ENDIF
    ENDPROC
ENDMODULE
