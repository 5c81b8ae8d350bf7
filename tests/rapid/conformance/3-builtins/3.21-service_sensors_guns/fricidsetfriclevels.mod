! rule: arguments of FricIdSetFricLevels
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num_2{2};
    PROC main()
        FricIdSetFricLevels v_num_2;
        FricIdSetFricLevels v_num_2 \MechUnit:=v_mecunit;
        FricIdSetFricLevels;  ! -> RG311?
    ENDPROC
ENDMODULE
