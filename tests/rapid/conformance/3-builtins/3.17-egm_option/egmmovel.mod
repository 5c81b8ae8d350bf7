! rule: arguments of EGMMoveL
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        EGMMoveL v_egmident, v_robtarget, v100, z10, p_tooldata;
        EGMMoveL v_egmident, v_robtarget, v100, z10, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata \NoCorr;
        EGMMoveL v_egmident, v_robtarget, v100, z10;  ! -> RG311
        EGMMoveL v_egmident, v_robtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
