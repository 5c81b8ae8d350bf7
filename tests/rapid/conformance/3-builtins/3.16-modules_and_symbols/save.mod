! rule: arguments of Save
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    PROC main()
        Save "x";
        Save \TaskRef:=v_taskid, "x" \FilePath:="x" \File:="x";
        Save \TaskName:="x", "x" \FilePath:="x" \File:="x";
        Save;  ! -> RG311?
        Save "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
