! rule: named values: modes
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := OP_UNDEF;
        n := OP_AUTO;
        n := OP_MAN_PROG;
        n := OP_MAN_TEST;
        n := RUN_UNDEF;
        n := RUN_CONT_CYCLE;
        n := RUN_INSTR_FWD;
        n := RUN_INSTR_BWD;
        n := RUN_SIM;
        n := RUN_STEP_MOVE;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
