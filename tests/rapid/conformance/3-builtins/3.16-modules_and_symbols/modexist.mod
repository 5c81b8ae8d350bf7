! rule: arguments of ModExist
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := ModExist("x");
        r_bool := ModExist();  ! -> RG311
        r_bool := ModExist("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
