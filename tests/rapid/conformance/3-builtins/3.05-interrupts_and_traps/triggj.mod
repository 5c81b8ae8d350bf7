! rule: arguments of TriggJ
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    VAR triggdata g;
    VAR triggdata a{3};
    PROC main()
        TriggJ p, v100, g, fine, tool0;
        TriggJ \Conc, p \ID:=1, v100 \T:=2, g \T2:=g \T3:=g \T4:=g \T5:=g \T6:=g \T7:=g \T8:=g, z10 \Inpos:=inpos50, tool0 \WObj:=w \TLoad:=l;
        TriggJ p, v100, a, fine, tool0;
        TriggJ p, v100, g, fine;  ! -> RG311
    ENDPROC
ENDMODULE
