! rule: arguments of CSpeedOverride
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := CSpeedOverride();
        r_num := CSpeedOverride(\CTask);
        r_num := CSpeedOverride(1);  ! -> RG311
        r_num := CSpeedOverride(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
