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
