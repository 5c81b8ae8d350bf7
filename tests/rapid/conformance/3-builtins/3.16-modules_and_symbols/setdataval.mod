! rule: arguments of SetDataVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR datapos v_datapos;
    VAR taskid v_taskid;
    PROC main()
        SetDataVal "x", 1;
        SetDataVal "x" \Block:=v_datapos, 1;
        SetDataVal "x" \TaskRef:=v_taskid, 1;
        SetDataVal "x" \TaskName:="x", 1;
        SetDataVal "x";  ! -> RG311
        SetDataVal "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
