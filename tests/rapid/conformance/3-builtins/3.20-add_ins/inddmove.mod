! rule: arguments of IndDMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        IndDMove v_mecunit, 1, 1, 1;
        IndDMove v_mecunit, 1, 1, 1 \Ramp:=1;
        IndDMove;  ! -> RG311?
        IndDMove v_mecunit, 1, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
