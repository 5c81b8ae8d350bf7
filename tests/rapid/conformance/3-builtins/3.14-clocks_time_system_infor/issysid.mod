! rule: arguments of IsSysId
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsSysId("x");
        r_bool := IsSysId();  ! -> RG311
        r_bool := IsSysId("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
