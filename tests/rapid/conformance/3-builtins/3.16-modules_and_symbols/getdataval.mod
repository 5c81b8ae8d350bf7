! rule: arguments of GetDataVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR datapos v_datapos;
    VAR taskid v_taskid;
    PROC main()
        GetDataVal "x", v_num;
        GetDataVal "x" \Block:=v_datapos, v_num;
        GetDataVal "x" \TaskRef:=v_taskid, v_num;
        GetDataVal "x" \TaskName:="x", v_num;
        GetDataVal "x";  ! -> RG311
        GetDataVal "x", v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
