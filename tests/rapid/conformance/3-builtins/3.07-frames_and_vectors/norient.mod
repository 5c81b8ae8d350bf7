! rule: arguments of NOrient
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient r_orient;
    PROC main()
        r_orient := NOrient([1, 0, 0, 0]);
        r_orient := NOrient();  ! -> RG311
        r_orient := NOrient([1, 0, 0, 0] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
