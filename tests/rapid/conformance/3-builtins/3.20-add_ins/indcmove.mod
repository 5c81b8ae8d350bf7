! rule: arguments of IndCMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        IndCMove v_mecunit, 1, 1;
        IndCMove v_mecunit, 1, 1 \Ramp:=1;
        IndCMove;  ! -> RG311?
        IndCMove v_mecunit, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
