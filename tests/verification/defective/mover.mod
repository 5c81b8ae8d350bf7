MODULE mover
    VAR intnum stop_bell;
    VAR intnum start_bell;
    VAR jointtarget own_target{40};
    VAR num own_seconds{40};
    VAR num own_size := 0;

    PROC main()
        ! Whatever was ordered before is over.
        give_up;
        IDelete stop_bell;
        CONNECT stop_bell WITH on_bell;
        IPers stop_asked, stop_bell;
        IDelete start_bell;
        CONNECT start_bell WITH on_bell;
        IPers interrupted, start_bell;
        WHILE TRUE DO
            IF stop_asked <> stop_done THEN
                give_up;
            ELSEIF ordered <> over THEN
                follow;
            ELSE
                WaitTime 0.02;
            ENDIF
        ENDWHILE
    ENDPROC

    PROC follow()
        VAR num order;

        IDisable;                                                             !-R7b
        WaitTestAndSet lock;
        order := ordered;
        own_size := size;
        FOR i FROM 1 TO own_size DO
            own_target{i} := target{i};
            own_seconds{i} := seconds{i};
        ENDFOR
        lock := FALSE;
        IEnable;                                                              !-R7b
        FOR i FROM 1 TO own_size DO
            IF stop_asked <> stop_done RETURN;                                !-R5
            IF i = own_size THEN
                MoveAbsJ own_target{i}, v100 \T:=own_seconds{i}, fine, tool0;
            ELSE
                MoveAbsJ own_target{i}, v100 \T:=own_seconds{i}, z10, tool0;
            ENDIF
        ENDFOR
        over := order;
    ENDPROC

    PROC give_up()
        VAR num asked;

        asked := stop_asked;
        StopMove;
        WaitRob \ZeroSpeed;
        ClearPath;
        over := ordered;
        StartMove;
        stop_done := asked;
    ENDPROC

    ! Main may be in a move, or just before one: it begins again.
    TRAP on_bell
        StopMove;
        ClearPath;
        ExitCycle;
    ENDTRAP

    ! Event routine STOP, QSTOP and RESTART: nothing of the path goes on. The stop stays until
    ! main has given up.
    PROC on_interruption()
        StopMove;
        ClearPath;
        interrupted := (interrupted + 1) MOD 1000;
    ENDPROC

    ! Event routine START: main begins, so whatever this task held it holds no more.
    PROC on_start()
        lock := FALSE;                                                        !-R7a
        interrupted := (interrupted + 1) MOD 1000;
    ENDPROC
ENDMODULE
