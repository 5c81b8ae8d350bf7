! rule: arguments of MoveExtJ
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PROC main()
        MoveExtJ v_jointtarget, v100, z10;
        MoveExtJ \Conc, v_jointtarget \ID:=1 \UseEOffs, v100 \T:=1, z10 \Inpos:=inpos50;
        MoveExtJ v_jointtarget, v100;  ! -> RG311
        MoveExtJ v_jointtarget, v100, z10 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
