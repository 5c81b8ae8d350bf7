! rule: arguments of IndRMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR robtarget v_robtarget;
    PROC main()
        IndRMove v_mecunit, 1, 1;
        IndRMove v_mecunit, 1 \ToRelPos:=v_robtarget \Short, 1 \Ramp:=1;
        IndRMove v_mecunit, 1 \ToRelNum:=1 \Fwd, 1 \Ramp:=1;
        IndRMove;  ! -> RG311?
        IndRMove v_mecunit, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
