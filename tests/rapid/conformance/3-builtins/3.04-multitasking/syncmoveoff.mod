! rule: arguments of SyncMoveOff
! source: [manual] 3HAC050917
MODULE Demo
    VAR syncident v_syncident;
    PROC main()
        SyncMoveOff v_syncident;
        SyncMoveOff v_syncident \TimeOut:=1;
        SyncMoveOff;  ! -> RG311?
        SyncMoveOff v_syncident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
