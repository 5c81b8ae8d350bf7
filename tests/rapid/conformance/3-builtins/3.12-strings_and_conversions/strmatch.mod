! rule: arguments of StrMatch
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := StrMatch("x", 1, "x");
        r_num := StrMatch("x", 1);  ! -> RG311
        r_num := StrMatch("x", 1, "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
