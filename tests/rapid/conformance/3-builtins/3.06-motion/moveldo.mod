! rule: arguments of MoveLDO
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    VAR signaldo s;
    PROC main()
        MoveLDO p, v100, z10, tool0, s, 1;
        MoveLDO p \ID:=1, v100 \T:=1, z10, tool0 \WObj:=w, s, high \TLoad:=l;
        MoveLDO p, v100, z10, tool0, s;  ! -> RG311
    ENDPROC
ENDMODULE
