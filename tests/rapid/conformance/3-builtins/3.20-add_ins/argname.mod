! rule: arguments of ArgName
! source: [manual] 3HAC050917
MODULE Demo
    VAR errnum v_errnum;
    VAR num v_num;
    VAR string r;
    PROC main()
        r := ArgName(v_num);
        r := ArgName(v_num \ErrorNumber:=v_errnum);
        r := ArgName();  ! -> RG311
        r := ArgName(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
