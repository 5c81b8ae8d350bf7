! rule: arguments of PrxSetSyncalarm
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxSetSyncalarm v_mecunit;
        PrxSetSyncalarm v_mecunit \Time:=v_num;
        PrxSetSyncalarm;  ! -> RG311?
    ENDPROC
ENDMODULE
