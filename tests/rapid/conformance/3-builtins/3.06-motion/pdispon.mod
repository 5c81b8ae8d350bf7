! rule: arguments of PDispOn
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    PROC main()
        PDispOn p, tool0;
        PDispOn \Rot \ExeP:=p, p, tool0 \WObj:=w;
        PDispOn p;  ! -> RG311
    ENDPROC
ENDMODULE
