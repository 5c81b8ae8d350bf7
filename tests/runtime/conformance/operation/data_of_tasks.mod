MODULE data_of_tasks
    ! source: [code] recovery programs read robtargets with \TaskName; a switch
    ! robot: irb120
    ! task: T_BACK back
    ! case: data_of_tasks=true
    ! do: start, run 1
    ! expect: 30
    ! expect: 31
    ! case: data_of_tasks=false
    ! do: start, run 1
    ! expect: refused
    TASK PERS num own := 30;
    PROC main()
        WaitTime 0.5;
    ENDPROC
    PROC back()
        VAR num found;
        VAR num next := 31;
        own := 4;
        GetDataVal "own" \TaskName:="T_ROB1", found;
        TPWrite ValToStr(found);
        SetDataVal "own" \TaskName:="T_ROB1", next;
        GetDataVal "own" \TaskName:="T_ROB1", found;
        TPWrite ValToStr(found);
        Stop;
    ERROR
        IF ERRNO = ERR_TASKNAME TPWrite "refused";
        Stop;
    ENDPROC
ENDMODULE
