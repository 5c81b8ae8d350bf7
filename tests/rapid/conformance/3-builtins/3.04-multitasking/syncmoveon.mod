! rule: arguments of SyncMoveOn
! source: [manual] 3HAC050917
MODULE Demo
    VAR syncident v_syncident;
    PERS tasks p_tasks_array{2};
    PROC main()
        SyncMoveOn v_syncident, p_tasks_array;
        SyncMoveOn v_syncident, p_tasks_array \TimeOut:=1;
        SyncMoveOn v_syncident;  ! -> RG311
        SyncMoveOn v_syncident, p_tasks_array \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
