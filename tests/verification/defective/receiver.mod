MODULE receiver
    VAR socketdev server;
    VAR socketdev client_1;
    VAR socketdev client_2;
    ! The other socket already holds the next client.
    VAR bool taken_over := FALSE;
    VAR bool linked := FALSE;
    VAR rawbytes message;
    VAR rawbytes answer;
    VAR num sequence := 0;
    ! The trajectory that is being received, and whether it is right so far.
    VAR jointtarget point{40};
    VAR num duration{40};
    VAR num count := 0;
    VAR bool right := FALSE;
    ! How often the program was interrupted before it began.
    VAR num interruptions := 0;

    PROC main()
        lock := FALSE;
        stop_robot;
        SocketCreate server;
        SocketBind server, "127.0.0.1", 11000;
        SocketListen server;
        WHILE TRUE DO
            serve client_1, client_2;
            serve client_2, client_1;
        ENDWHILE
    ENDPROC

    PROC serve(VAR socketdev client, VAR socketdev newcomer)
        VAR num received := 0;

        IF NOT taken_over SocketAccept server, client \Time:=WAIT_MAX;
        taken_over := FALSE;
        linked := TRUE;
        right := FALSE;
        WHILE linked AND (NOT taken_over) DO
            received := next_message(client);
            IF received = 68 THEN
                take client;
            ELSEIF received < 0 THEN
                linked := FALSE;
            ELSE
                taken_over := came(newcomer);                                 !-R12
            ENDIF
        ENDWHILE
        ! No task waits for that here: the next client may already be talking.
        stop_asked := (stop_asked + 1) MOD 1000;
        SocketClose client;
    ENDPROC

    ! Bytes of the next message: 68, 0 when there is none for a second, -1 without a link.
    FUNC num next_message(VAR socketdev client)
        VAR num received := 0;

        SocketReceive client \RawData:=message \ReadNoOfBytes:=68 \NoRecBytes:=received \Time:=1;
        RETURN received;
    ERROR
        SkipWarn;
        IF ERRNO = ERR_SOCK_TIMEOUT RETURN 0;
        RETURN -1;
    ENDFUNC

    FUNC bool came(VAR socketdev newcomer)
        SocketAccept server, newcomer \Time:=0.001;
        RETURN TRUE;
    ERROR
        SkipWarn;
        RETURN FALSE;
    ENDFUNC

    PROC take(VAR socketdev client)
        UnpackRawBytes message, 17, sequence \IntX:=DINT;
        IF sequence = -4 THEN
            right := FALSE;
            stop_robot;                                                       !-R5
            !+R5 stop_asked := (stop_asked + 1) MOD 1000;
            !+R5 StopMove;
            !+R5 ClearPath;
            !+R5 StartMove;
            reply client;
            RETURN;
        ENDIF
        IF sequence = -1 THEN
            interruptions := interrupted;
            stop_robot;
            count := 0;
            right := TRUE;
        ENDIF
        IF sequence > 0 AND sequence <> count right := FALSE;
        add;
        IF sequence = -3 hand_over;
    ENDPROC

    PROC add()
        VAR num joint{6} := [0,0,0,0,0,0];

        IF count = CAPACITY THEN
            ! One too many: none of them counts.
            right := FALSE;                                                   !-R1
            RETURN;
        ENDIF
        count := count + 1;
        FOR i FROM 1 TO 6 DO
            UnpackRawBytes message, 17 + 4 * i, joint{i} \Float4;
            joint{i} := joint{i} * 57.29578;
        ENDFOR
        UnpackRawBytes message, 65, duration{count} \Float4;
        point{count} := [[joint{1},joint{2},joint{3},joint{4},joint{5},joint{6}],
            [9E9,9E9,9E9,9E9,9E9,9E9]];
    ENDPROC

    ! The end has come: order the whole trajectory, if the robot stands where it begins.
    PROC hand_over()
        IF NOT (right AND begins_here()) RETURN;
        ! The program was stopped or started meanwhile: no client expects an order now.
        IF interrupted <> interruptions RETURN;
        right := FALSE;
        duration{1} := 0.2;
        WaitTestAndSet lock;
        size := count;
        FOR i FROM 1 TO count DO
            target{i} := point{i};
            seconds{i} := duration{i};
        ENDFOR
        ordered := (ordered + 1) MOD 1000;
        lock := FALSE;
    ENDPROC

    FUNC bool begins_here()
        VAR jointtarget here;

        here := CJointT();
        RETURN Abs(here.robax.rax_1 - point{1}.robax.rax_1) < 0.5
            AND Abs(here.robax.rax_2 - point{1}.robax.rax_2) < 0.5
            AND Abs(here.robax.rax_3 - point{1}.robax.rax_3) < 0.5
            AND Abs(here.robax.rax_4 - point{1}.robax.rax_4) < 0.5
            AND Abs(here.robax.rax_5 - point{1}.robax.rax_5) < 0.5
            AND Abs(here.robax.rax_6 - point{1}.robax.rax_6) < 0.5;
    ENDFUNC

    ! Ask the mover to give up, and wait until it has.
    PROC stop_robot()
        VAR bool late := FALSE;

        stop_asked := (stop_asked + 1) MOD 1000;
        WaitUntil stop_done = stop_asked \MaxTime:=0.3 \TimeFlag:=late;
    ENDPROC

    PROC reply(VAR socketdev client)
        ClearRawBytes answer;
        PackRawBytes 12, answer, 1 \IntX:=DINT;
        PackRawBytes 11, answer, 5 \IntX:=DINT;
        PackRawBytes 3, answer, 9 \IntX:=DINT;
        PackRawBytes 1, answer, 13 \IntX:=DINT;
        SocketSend client \RawData:=answer;
    ERROR
        SkipWarn;
        linked := FALSE;
        RETURN;
    ENDPROC
ENDMODULE
