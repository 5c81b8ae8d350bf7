! rule: arguments of FileTimeDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR string v_string;
    VAR stringdig v_stringdig;
    PROC main()
        result := FileTimeDnum(v_string);
        result := FileTimeDnum(v_string \ModifyTime \StrDig:=v_stringdig);
        result := FileTimeDnum();  ! -> RG311
    ENDPROC
ENDMODULE
