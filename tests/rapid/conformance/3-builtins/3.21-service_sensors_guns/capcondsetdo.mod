! rule: arguments of CapCondSetDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR dionum v_dionum;
    VAR signaldo v_signaldo;
    PROC main()
        CapCondSetDO v_signaldo, v_dionum;
        CapCondSetDO;  ! -> RG311?
    ENDPROC
ENDMODULE
