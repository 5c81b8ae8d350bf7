! rule: arguments of MoveJDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    VAR signaldo v_signaldo;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveJDO v_robtarget, v100, z10, p_tooldata, v_signaldo, 1;
        MoveJDO v_robtarget \ID:=1, v100 \T:=1, z10, p_tooldata \WObj:=p_wobjdata, v_signaldo, 1 \TLoad:=p_loaddata;
        MoveJDO v_robtarget, v100, z10, p_tooldata, v_signaldo;  ! -> RG311
        MoveJDO v_robtarget, v100, z10, p_tooldata, v_signaldo, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
