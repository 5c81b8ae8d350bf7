! rule: arguments of ResetAxisDistance
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        ResetAxisDistance v_mecunit, v_num;
        ResetAxisDistance;  ! -> RG311?
    ENDPROC
ENDMODULE
