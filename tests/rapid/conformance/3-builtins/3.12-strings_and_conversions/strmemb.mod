! rule: arguments of StrMemb
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := StrMemb("x", 1, "x");
        r_bool := StrMemb("x", 1);  ! -> RG311
        r_bool := StrMemb("x", 1, "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
