! rule: arguments of IndReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR robtarget v_robtarget;
    PROC main()
        IndReset v_mecunit, 1;
        IndReset v_mecunit, 1 \RefPos:=v_robtarget \Short;
        IndReset v_mecunit, 1 \RefNum:=1 \Fwd;
        IndReset;  ! -> RG311?
        IndReset v_mecunit, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
