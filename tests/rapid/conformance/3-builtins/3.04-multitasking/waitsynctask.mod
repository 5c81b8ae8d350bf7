! rule: arguments of WaitSyncTask
! source: [manual] 3HAC050917
MODULE Demo
    VAR syncident v_syncident;
    PERS tasks p_tasks_array{2};
    PROC main()
        WaitSyncTask v_syncident, p_tasks_array;
        WaitSyncTask \InPos, v_syncident, p_tasks_array \TimeOut:=1;
        WaitSyncTask v_syncident;  ! -> RG311
        WaitSyncTask v_syncident, p_tasks_array \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
