! rule: arguments of MoveL
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveL v_robtarget, v100, z10, p_tooldata;
        MoveL \Conc, v_robtarget \ID:=1, v100 \V:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveL \Conc, v_robtarget \ID:=1, v100 \T:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveL v_robtarget, v100, z10;  ! -> RG311
        MoveL v_robtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
