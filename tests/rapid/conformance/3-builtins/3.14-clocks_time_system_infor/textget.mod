! rule: arguments of TextGet
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := TextGet(1, 1);
        r_string := TextGet(1);  ! -> RG311
        r_string := TextGet(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
