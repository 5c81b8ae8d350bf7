! rule: arguments of ModTimeDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR string v_string;
    VAR stringdig v_stringdig;
    PROC main()
        result := ModTimeDnum(v_string);
        result := ModTimeDnum(v_string \StrDig:=v_stringdig);
        result := ModTimeDnum();  ! -> RG311
    ENDPROC
ENDMODULE
