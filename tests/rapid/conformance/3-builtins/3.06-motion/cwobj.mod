! rule: arguments of CWObj
! source: [manual] 3HAC050917
MODULE Demo
    VAR wobjdata r_wobjdata;
    VAR taskid v_taskid;
    PROC main()
        r_wobjdata := CWObj();
        r_wobjdata := CWObj(\TaskRef:=v_taskid);
        r_wobjdata := CWObj(\TaskName:="x");
        r_wobjdata := CWObj(1);  ! -> RG311
        r_wobjdata := CWObj(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
