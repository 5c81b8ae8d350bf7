! rule: arguments of CRobT
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget r_robtarget;
    VAR taskid v_taskid;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        r_robtarget := CRobT();
        r_robtarget := CRobT(\TaskRef:=v_taskid \Tool:=p_tooldata \WObj:=p_wobjdata);
        r_robtarget := CRobT(\TaskName:="x" \Tool:=p_tooldata \WObj:=p_wobjdata);
        r_robtarget := CRobT(1);  ! -> RG311
        r_robtarget := CRobT(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
