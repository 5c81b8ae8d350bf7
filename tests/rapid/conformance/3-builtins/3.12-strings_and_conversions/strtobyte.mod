! rule: arguments of StrToByte
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := StrToByte("x");
        r_byte := StrToByte("x" \Hex);
        r_byte := StrToByte("x" \Okt);
        r_byte := StrToByte("x" \Bin);
        r_byte := StrToByte("x" \Char);
        r_byte := StrToByte();  ! -> RG311
        r_byte := StrToByte("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
