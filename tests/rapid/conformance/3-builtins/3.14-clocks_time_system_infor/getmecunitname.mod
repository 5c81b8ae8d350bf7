! rule: arguments of GetMecUnitName
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR string r_string;
    PROC main()
        r_string := GetMecUnitName(v_mecunit);
        r_string := GetMecUnitName();  ! -> RG311
        r_string := GetMecUnitName(v_mecunit \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
