! rule: arguments of OrientZYX
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient r_orient;
    PROC main()
        r_orient := OrientZYX(1, 1, 1);
        r_orient := OrientZYX(1, 1);  ! -> RG311
        r_orient := OrientZYX(1, 1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
