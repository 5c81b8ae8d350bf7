! rule: arguments of FileTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR stringdig v_stringdig;
    PROC main()
        r_num := FileTime("x");
        r_num := FileTime("x" \ModifyTime \StrDig:=v_stringdig);
        r_num := FileTime("x" \AccessTime \StrDig:=v_stringdig);
        r_num := FileTime("x" \StatCTime \StrDig:=v_stringdig);
        r_num := FileTime();  ! -> RG311
        r_num := FileTime("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
