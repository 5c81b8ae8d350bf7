! rule: arguments of MoveLSync
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveLSync v_robtarget, v100, z10, p_tooldata, "x";
        MoveLSync v_robtarget \ID:=1, v100 \T:=1, z10, p_tooldata \WObj:=p_wobjdata, "x" \TLoad:=p_loaddata;
        MoveLSync v_robtarget, v100, z10, p_tooldata;  ! -> RG311
        MoveLSync v_robtarget, v100, z10, p_tooldata, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
