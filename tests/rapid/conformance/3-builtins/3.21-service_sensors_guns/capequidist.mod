! rule: arguments of CapEquiDist
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        CapEquiDist;
        CapEquiDist \Distance:=v_num \Reset;
        CapEquiDist 1;  ! -> RG311?
    ENDPROC
ENDMODULE
