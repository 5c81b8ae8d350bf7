! rule: arguments of ByteToStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := ByteToStr(1);
        r_string := ByteToStr(1 \Hex);
        r_string := ByteToStr(1 \Okt);
        r_string := ByteToStr(1 \Bin);
        r_string := ByteToStr(1 \Char);
        r_string := ByteToStr();  ! -> RG311
        r_string := ByteToStr(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
