! rule: arguments of GetAxisMoveTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        result := GetAxisMoveTime(v_mecunit, v_num);
        result := GetAxisMoveTime();  ! -> RG311
    ENDPROC
ENDMODULE
