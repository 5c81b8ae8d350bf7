! rule: arguments of IndSpeed
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r;
    VAR mecunit v_mecunit;
    PROC main()
        r := IndSpeed(v_mecunit, 1);
        r := IndSpeed(v_mecunit, 1 \InSpeed);
        r := IndSpeed(v_mecunit, 1 \ZeroSpeed);
        r := IndSpeed();  ! -> RG311
        r := IndSpeed(v_mecunit, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
