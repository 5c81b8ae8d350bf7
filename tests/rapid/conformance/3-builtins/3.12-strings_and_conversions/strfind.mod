! rule: arguments of StrFind
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := StrFind("x", 1, "x");
        r_num := StrFind("x", 1, "x" \NotInSet);
        r_num := StrFind("x", 1);  ! -> RG311
        r_num := StrFind("x", 1, "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
