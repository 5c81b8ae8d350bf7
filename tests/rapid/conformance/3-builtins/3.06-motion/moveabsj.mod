! rule: arguments of MoveAbsJ
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveAbsJ v_jointtarget, v100, z10, p_tooldata;
        MoveAbsJ \Conc, v_jointtarget \ID:=1 \NoEOffs, v100 \V:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata;
        MoveAbsJ \Conc, v_jointtarget \ID:=1 \NoEOffs, v100 \T:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata;
        MoveAbsJ v_jointtarget, v100, z10;  ! -> RG311
        MoveAbsJ v_jointtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
