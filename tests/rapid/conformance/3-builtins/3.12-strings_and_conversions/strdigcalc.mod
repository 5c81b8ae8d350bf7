! rule: arguments of StrDigCalc
! source: [manual] 3HAC050917
MODULE Demo
    VAR stringdig r_stringdig;
    PROC main()
        r_stringdig := StrDigCalc("1", 1, "1");
        r_stringdig := StrDigCalc("1", 1);  ! -> RG311
        r_stringdig := StrDigCalc("1", 1, "1" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
