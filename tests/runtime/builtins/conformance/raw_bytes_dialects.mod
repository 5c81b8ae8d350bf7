MODULE raw_bytes_dialects
    ! source: 3HAC16581-1 [manual] says nothing of a gap, of what is beyond the valid length; [mem] what is done
    ! case:
    ! A gap is filled with 0.
    ! expect: 8 513
    ! expect: beyond
    ! expect: kept 5
    ! case: pack_beyond=error
    ! expect: beyond
    ! expect: 6 513
    ! expect: beyond
    ! expect: kept 5
    ! case: unpack_beyond=zero
    ! expect: 8 513
    ! expect: 513
    ! expect: beyond
    PROC main()
        VAR rawbytes raw;
        VAR num n;
        PackRawBytes "ab", raw, 1 \ASCII;
        PackRawBytes 513, raw, 5 \IntX:=DINT;
        IF RawBytesLen(raw) = 2 PackRawBytes 513, raw, 3 \IntX:=DINT;
        UnpackRawBytes raw, RawBytesLen(raw) - 3, n \IntX:=DINT;
        TPWrite ValToStr(RawBytesLen(raw)) + " " + ValToStr(n);
        IF RawBytesLen(raw) = 8 THEN
            UnpackRawBytes raw, 3, n \IntX:=INT;
            IF n <> 0 TPWrite "not 0";
        ENDIF
        beyond;
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "beyond";
        TRYNEXT;
    ENDPROC
    PROC beyond()
        VAR rawbytes raw;
        VAR rawbytes none;
        VAR num n := 5;
        PackRawBytes 513, raw, 1 \IntX:=INT;
        UnpackRawBytes raw, 1, n \IntX:=DINT;
        IF n = 513 TPWrite "513";
        UnpackRawBytes none, 1023, n \IntX:=DINT;
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "beyond";
        IF n = 5 TPWrite "kept 5";
        RETURN;
    ENDPROC
ENDMODULE
