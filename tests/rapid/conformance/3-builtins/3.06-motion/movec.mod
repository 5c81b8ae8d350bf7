! rule: arguments of MoveC
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveC v_robtarget, v_robtarget, v100, z10, p_tooldata;
        MoveC \Conc, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveC \Conc, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveC v_robtarget, v_robtarget, v100, z10;  ! -> RG311
        MoveC v_robtarget, v_robtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
