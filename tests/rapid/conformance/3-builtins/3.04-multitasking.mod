!=== gettaskname
! rule: arguments of GetTaskName
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    VAR num v_num;
    PROC main()
        r_string := GetTaskName();
        r_string := GetTaskName(\TaskNo:=v_num \MecTaskNo:=v_num);
        r_string := GetTaskName(1);  ! -> RG311
        r_string := GetTaskName(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== motionplannerno
! rule: arguments of MotionPlannerNo
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := MotionPlannerNo();
        r_num := MotionPlannerNo(1);  ! -> RG311
        r_num := MotionPlannerNo(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== nonmotionmode
! rule: arguments of NonMotionMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR symnum r_symnum;
    PROC main()
        r_symnum := NonMotionMode();
        r_symnum := NonMotionMode(\Main);
        r_symnum := NonMotionMode(1);  ! -> RG311
        r_symnum := NonMotionMode(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== robname
! rule: arguments of RobName
! source: [mem]
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := RobName();
        r_string := RobName(1);  ! -> RG311
        r_string := RobName(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== syncmoveoff
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
!=== syncmoveon
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
!=== syncmoveresume
! rule: arguments of SyncMoveResume
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SyncMoveResume;
        SyncMoveResume 1;  ! -> RG311
        SyncMoveResume \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== syncmovesuspend
! rule: arguments of SyncMoveSuspend
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SyncMoveSuspend;
        SyncMoveSuspend 1;  ! -> RG311
        SyncMoveSuspend \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== taskisactive
! rule: arguments of TaskIsActive
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    VAR bool r_bool;
    PROC main()
        r_bool := TaskIsActive(v_taskid);
        r_bool := TaskIsActive("x");
        r_bool := TaskIsActive();  ! -> RG311
        r_bool := TaskIsActive(v_taskid \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== taskisexecuting
! rule: arguments of TaskIsExecuting
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    VAR bool r_bool;
    PROC main()
        r_bool := TaskIsExecuting(v_taskid);
        r_bool := TaskIsExecuting("x");
        r_bool := TaskIsExecuting();  ! -> RG311
        r_bool := TaskIsExecuting(v_taskid \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== taskrunmec
! rule: arguments of TaskRunMec
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := TaskRunMec();
        r_bool := TaskRunMec(1);  ! -> RG311
        r_bool := TaskRunMec(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== taskrunrob
! rule: arguments of TaskRunRob
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := TaskRunRob();
        r_bool := TaskRunRob(1);  ! -> RG311
        r_bool := TaskRunRob(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== testandset
! rule: arguments of TestAndSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR bool r_bool;
    PROC main()
        r_bool := TestAndSet(v_bool);
        r_bool := TestAndSet();  ! -> RG311
        r_bool := TestAndSet(v_bool \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitsynctask
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
!=== waittestandset
! rule: arguments of WaitTestAndSet
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    PROC main()
        WaitTestAndSet p_bool;
        WaitTestAndSet;  ! -> RG311?
        WaitTestAndSet p_bool \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== moves_without_identity
! rule: between SyncMoveOn and SyncMoveOff a move has an \ID
! source: [manual] 3HAC050917 SyncMoveOn
MODULE Demo
    PERS tasks both{2} := [["T_ROB1"], ["T_ROB2"]];
    VAR syncident begins;
    VAR syncident ends;
    VAR robtarget p;
    VAR jointtarget j;
    VAR bool ready;
    PROC main()
        MoveL p, v100, fine, tool0;
        SyncMoveOn begins, both;
        MoveL p \ID:=10, v100, fine, tool0;
        MoveL p, v100, fine, tool0;  ! -> RG335?
        MoveAbsJ j, v100, fine, tool0;  ! -> RG335?
        inside;  ! -> RG335?
        WaitTime 1;
        SyncMoveSuspend;
        inside;
        SyncMoveResume;
        IF ready THEN
            MoveJ p, v100, fine, tool0;  ! -> RG335?
            SyncMoveOff ends;
        ELSE
            SyncMoveOff ends;
            MoveJ p, v100, fine, tool0;
        ENDIF
        MoveL p, v100, fine, tool0;
        IF ready SyncMoveOn begins, both;
        MoveL p, v100, fine, tool0;
        complete;
        complete;
    ENDPROC
    PROC inside()
        MoveL p, v100, fine, tool0;
    ENDPROC
    PROC complete()
        SyncMoveOn begins, both;
        MoveL p, v100, fine, tool0;  ! -> RG335?
        SyncMoveOff ends;
    ENDPROC
ENDMODULE
