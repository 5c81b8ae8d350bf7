!=== handler_statements
! rule: RETRY, TRYNEXT, RETURN and RAISE in a handler
! source: [K §4.8, 4.10, 4.11]
MODULE Demo
    PROC main()
        TPErase;
    ERROR
        TEST ERRNO
        CASE 1:
            RETRY;
        CASE 2:
            TRYNEXT;
        CASE 3:
            RETURN;
        DEFAULT:
            RAISE;
        ENDTEST
    ENDPROC
ENDMODULE
!=== handlers_see_routine_data
! rule: handlers see the data of their routine
! source: [K §6.1, 7.1]
MODULE Demo
    PROC main()
        VAR num a;
        a := 1;
    ERROR
        TPWrite "" \Num:=a;
        RETRY;
    ENDPROC
ENDMODULE
!=== raise_constant
! rule: RAISE takes a constant or a booked number
! source: [K §7.1] [code] abb_driver
MODULE Demo
    CONST errnum MY_ERROR := 17;
    VAR bool a;
    PROC main()
        IF a RAISE ERR_ARGVALERR;
        RAISE MY_ERROR;
    ENDPROC
ENDMODULE
!=== raise_in_undo
! rule: no RAISE, RETRY or TRYNEXT in an UNDO handler
! source: [K §4.8]
MODULE Demo
    PROC main()
    UNDO
        RAISE;  ! -> RG321
    ENDPROC
ENDMODULE
!=== raise_number_in_handler
! rule: RAISE n in a handler gives the caller another error
! source: [code] ABB's Modbus modules for RobotWare 7; [K §4.8] has it in bodies only
MODULE Demo
    PROC main()
        TPErase;
    ERROR
        RAISE 5;  ! -> RG321~
    ENDPROC
ENDMODULE
!=== raise_outside
! rule: RAISE stands in an ERROR handler only
! source: [K §4.8, 4.10, 4.11]
MODULE Demo
    PROC main()
        RAISE;  ! -> RG321
    ENDPROC
ENDMODULE
!=== raise_range
! rule: own error numbers are 1 to 90
! source: [K §4.8, 7.1]
MODULE Demo
    VAR bool a;
    PROC main()
        IF a RAISE 90;
        RAISE 91;  ! -> RG321
    ENDPROC
ENDMODULE
!=== recovery_point
! rule: ERROR with a list of numbers
! source: [K §7.2] [code] open_abb
MODULE Demo
    CONST errnum MY_ERROR := 17;
    PROC main()
        TPErase;
    ERROR (MY_ERROR, 18, LONG_JMP_ALL_ERR)
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== recovery_point_whole_data
! rule: the numbers behind ERROR are literals and whole data
! source: [K §7.2]
MODULE Demo
    CONST errnum MY_ERRORS{2} := [17, 18];
    PROC element()
        TPErase;
    ERROR (MY_ERRORS{1})  ! -> RG201
        TRYNEXT;
    ENDPROC
    PROC expression()
        TPErase;
    ERROR (17 + 1)  ! -> RG201
        TRYNEXT;
    ENDPROC
    PROC main()
        TPErase;
    ERROR (17, ERR_DIVZERO)
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== retry_outside
! rule: RETRY stands in an ERROR handler only
! source: [K §4.8, 4.10, 4.11]
MODULE Demo
    PROC main()
        RETRY;  ! -> RG321
    ENDPROC
ENDMODULE
!=== trynext_outside
! rule: TRYNEXT stands in an ERROR handler only
! source: [K §4.8, 4.10, 4.11]
MODULE Demo
    PROC main()
        TRYNEXT;  ! -> RG321
    ENDPROC
ENDMODULE
!=== handler_moves
! rule: a move in a trap or error handler needs StorePath before it
! source: [manual] 3HAC050917 StorePath; the log of an IRB 120 with 5.15 has 41739 for each move of a trap
MODULE Demo
    VAR robtarget p;
    VAR bool ready;
    TRAP bare
        MoveL p, v100, fine, tool0;  ! -> RG334?
        MoveL p, v100, fine, tool0;
    ENDTRAP
    TRAP good
        StopMove;
        StorePath;
        MoveL p, v100, fine, tool0;
        RestoPath;
    ENDTRAP
    TRAP by_call
        IF ready THEN
            far;  ! -> RG334?
        ENDIF
    ENDTRAP
    TRAP stored_by_call
        keep;
        far;
    ENDTRAP
    PROC keep()
        StorePath;
    ENDPROC
    PROC far()
        near;
    ENDPROC
    PROC near()
        MoveJ p, v100, fine, tool0;
        IF ready far;
    ENDPROC
    PROC main()
        MoveL p, v100, fine, tool0;
    ERROR
        TEST ERRNO
        CASE ERR_DIVZERO:
            StorePath;
            MoveL p, v100, fine, tool0;
            RestoPath;
        CASE ERR_ARGVALERR:
            MoveL p, v100, fine, tool0;  ! -> RG334~
        ENDTEST
        TRYNEXT;
    ENDPROC
ENDMODULE
