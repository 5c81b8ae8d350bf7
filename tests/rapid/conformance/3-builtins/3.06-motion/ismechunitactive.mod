! rule: arguments of IsMechUnitActive
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR bool r_bool;
    PROC main()
        r_bool := IsMechUnitActive(v_mecunit);
        r_bool := IsMechUnitActive();  ! -> RG311
        r_bool := IsMechUnitActive(v_mecunit \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
