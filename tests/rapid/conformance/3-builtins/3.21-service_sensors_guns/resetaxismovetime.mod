! rule: arguments of ResetAxisMoveTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        ResetAxisMoveTime v_mecunit, v_num;
        ResetAxisMoveTime;  ! -> RG311?
    ENDPROC
ENDMODULE
