! rule: arguments of GetTSPStatus
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    VAR tsp_status result;
    PROC main()
        result := GetTSPStatus(v_taskid);
        result := GetTSPStatus();  ! -> RG311
    ENDPROC
ENDMODULE
