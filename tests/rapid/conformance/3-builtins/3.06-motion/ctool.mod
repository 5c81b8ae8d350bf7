! rule: arguments of CTool
! source: [manual] 3HAC050917
MODULE Demo
    VAR tooldata r_tooldata;
    VAR taskid v_taskid;
    PROC main()
        r_tooldata := CTool();
        r_tooldata := CTool(\TaskRef:=v_taskid);
        r_tooldata := CTool(\TaskName:="x");
        r_tooldata := CTool(1);  ! -> RG311
        r_tooldata := CTool(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
