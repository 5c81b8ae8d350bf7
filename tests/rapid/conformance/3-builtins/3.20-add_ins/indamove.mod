! rule: arguments of IndAMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR robtarget v_robtarget;
    PROC main()
        IndAMove v_mecunit, 1, 1;
        IndAMove v_mecunit, 1 \ToAbsPos:=v_robtarget, 1 \Ramp:=1;
        IndAMove v_mecunit, 1 \ToAbsNum:=1, 1 \Ramp:=1;
        IndAMove;  ! -> RG311?
        IndAMove v_mecunit, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
