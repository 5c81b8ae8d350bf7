! rule: arguments of StrOrder
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := StrOrder("x", "x", "x");
        r_bool := StrOrder("x", "x");  ! -> RG311
        r_bool := StrOrder("x", "x", "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
