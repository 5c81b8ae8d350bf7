! rule: arguments of PrxSetPosOffset
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxSetPosOffset v_mecunit, v_num;
        PrxSetPosOffset;  ! -> RG311?
    ENDPROC
ENDMODULE
