MODULE procerr_recovery
    ! source: [K §7.4] asynchronously raised errors, of the example there
    ! robot: irb120
    ! signal: diFail DI
    ! expect: begins
    ! expect: process ERR_PATH_STOP, stopped TRUE
    ! expect: at the end
    ! expect: logged
    ! expect: process ERR_PATH_STOP, stopped TRUE
    ! expect: logged
    ! expect: at the end
    ! expect: logs
    ! expect: process ERR_PATH_STOP, stopped TRUE
    ! expect: logs
    ! expect: logged
    ! expect: at the end
    VAR intnum fails;
    VAR num kind := 1;
    CONST jointtarget a := [[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget b := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC main()
        CONNECT fails WITH failure;
        ITimer \Single, 0.3, fails;
        TPWrite "begins";
        one_move;
        ! SyncLast while PP is in a routine without moves: it waits for the next move
        order;
        two_moves;
        kind := 2;
        order;
        with_a_log;
        IDelete fails;
    ERROR
        TPWrite "never";
        TRYNEXT;
    ENDPROC

    PROC order()
        IDelete fails;
        CONNECT fails WITH failure;
        ITimer \Single, 0.3, fails;
    ENDPROC

    PROC one_move()
        MoveAbsJ a, v200, fine, tool0;
        IF reached(a) TPWrite "at the end";
    ERROR
        recover;
        RETRY;
    ENDPROC

    PROC two_moves()
        MoveAbsJ \Conc, b, v200, z10, tool0;
        write_log;
        MoveAbsJ a, v200, z10, tool0;
        TPWrite "logged";
        WaitRob \InPos;
        IF reached(a) TPWrite "at the end";
    ERROR
        recover;
        RETRY;
    ENDPROC

    PROC with_a_log()
        MoveAbsJ \Conc, b, v200, z10, tool0;
        talk;
        WaitRob \InPos;
        IF reached(b) TPWrite "at the end";
    ERROR
        recover;
        RETRY;
    ENDPROC

    PROC talk()
        TPWrite "logs";
        write_log;
    ERROR
        TPWrite "never";
    ENDPROC

    PROC write_log()
        VAR num n;
        WHILE n < 100 DO
            n := n + 1;
            WaitTime 0.01;
        ENDWHILE
        TPWrite "logged";
    ENDPROC

    PROC recover()
        IF ERRNO = ERR_PATH_STOP TPWrite "process ERR_PATH_STOP, stopped " \Bool:=IsStopMoveAct(\FromMoveTask);
        StartMove;
    ENDPROC

    FUNC bool reached(jointtarget point)
        VAR jointtarget here;
        here := CJointT();
        RETURN Abs(here.robax.rax_1 - point.robax.rax_1) < 0.01;
    ENDFUNC

    TRAP failure
        IF kind = 1 ProcerrRecovery \SyncLastMoveInst;
        IF kind = 2 ProcerrRecovery \SyncOrgMoveInst;
        RETURN;
    ENDTRAP
ENDMODULE
