! rule: arguments of GetAxisDistance
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        result := GetAxisDistance(v_mecunit, v_num);
        result := GetAxisDistance();  ! -> RG311
    ENDPROC
ENDMODULE
