!=== assign_call
! rule: a call is no target
! source: [K §4.4]
MODULE Demo
    PROC main()
        Abs(1) := 2;  ! -> RG201
    ENDPROC
ENDMODULE
!=== assign_constant
! rule: a constant is not assigned
! source: [K §4.4]
MODULE Demo
    CONST num c := 1;
    PROC main()
        c := 2;  ! -> RG310
    ENDPROC
ENDMODULE
!=== assign_errno
! rule: ERRNO and INTNO are read-only
! source: [K §7.1, 8.3]
MODULE Demo
    PROC main()
        ERRNO := 1;  ! -> RG310
        INTNO := 1;  ! -> RG310
    ENDPROC
ENDMODULE
!=== assign_loop_variable
! rule: a loop variable is read-only
! source: [K §4.15]
MODULE Demo
    PROC main()
        FOR i FROM 1 TO 3 DO
            i := 5;  ! -> RG310
        ENDFOR
    ENDPROC
ENDMODULE
!=== call_of_function
! rule: a call of a FUNC is no statement
! source: [K §4]
MODULE Demo
    PROC main()
        f;  ! -> RG306
    ENDPROC
    FUNC num f()
        RETURN 1;
    ENDFUNC
ENDMODULE
!=== compact_if_assignment
! rule: a compact IF takes a simple statement: assignment
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 a := 2;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== compact_if_call
! rule: a compact IF takes a simple statement: call
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 TPErase;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== compact_if_connect
! rule: a compact IF takes a simple statement: connect
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 CONNECT i WITH t;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== compact_if_exit
! rule: a compact IF takes a simple statement: exit
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 EXIT;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== compact_if_goto
! rule: a compact IF takes a simple statement: goto
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 GOTO out;
        out:
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== compact_if_in_handler
! rule: RETRY and TRYNEXT in a compact IF
! source: [K §4.14]
MODULE Demo
    PROC main()
        TPErase;
    ERROR
        IF ERRNO = 1 RETRY;
        IF ERRNO = 2 TRYNEXT;
    ENDPROC
ENDMODULE
!=== compact_if_raise
! rule: a compact IF takes a simple statement: raise
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 RAISE 5;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== compact_if_refuses_for
! rule: a compact IF takes no compound statement
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 FOR i FROM 1 TO 2 DO  ! -> RG201
        ENDFOR
    ENDPROC
ENDMODULE
!=== compact_if_refuses_if
! rule: a compact IF takes no compound statement
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 IF b = 1 a := 2;  ! -> RG201
    ENDPROC
ENDMODULE
!=== compact_if_refuses_test
! rule: a compact IF takes no compound statement
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 TEST a  ! -> RG201
        ENDTEST
    ENDPROC
ENDMODULE
!=== compact_if_refuses_while
! rule: a compact IF takes no compound statement
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 WHILE TRUE DO  ! -> RG201
        ENDWHILE
    ENDPROC
ENDMODULE
!=== compact_if_return
! rule: a compact IF takes a simple statement: return
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 RETURN;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== connect
! rule: CONNECT takes a variable of the module and a trap
! source: [K §4.12]
MODULE Demo
    VAR intnum i;
    PROC main()
        CONNECT i WITH t;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== connect_constant
! rule: CONNECT takes a variable
! source: [K §4.12]
MODULE Demo
    CONST intnum i := 1;
    PROC main()
        CONNECT i WITH t;  ! -> RG326
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== connect_late
! rule: the trap of CONNECT is a name, not bound late
! source: [K §4.12]
MODULE Demo
    VAR intnum i;
    TRAP t
    ENDTRAP
    PROC main()
        CONNECT i WITH %"t"%;  ! -> RG201
        CONNECT i WITH t;
    ENDPROC
ENDMODULE
!=== connect_procedure
! rule: CONNECT takes a trap
! source: [K §4.12]
MODULE Demo
    VAR intnum i;
    PROC main()
        CONNECT i WITH main;  ! -> RG306
    ENDPROC
ENDMODULE
!=== connect_routine_variable
! rule: a routine variable is accepted with a warning
! source: [K §4.12, 8.2]
MODULE Demo
    PROC main()
        VAR intnum i;
        CONNECT i WITH t;  ! -> RG326?
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== connect_type
! rule: CONNECT takes a num
! source: [K §4.12]
MODULE Demo
    VAR string i;
    PROC main()
        CONNECT i WITH t;  ! -> RG307
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== empty_lists
! rule: statement lists may be empty
! source: [K §4.2]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 THEN
        ELSE
        ENDIF
        FOR i FROM 1 TO 2 DO
        ENDFOR
        TEST a
        ENDTEST
    ENDPROC
ENDMODULE
!=== exit
! rule: EXIT ends the task
! source: [K §4.9]
MODULE Demo
    PROC main()
        EXIT;
        TPErase;  ! -> RG323?
    ENDPROC
ENDMODULE
!=== for
! rule: FOR with and without STEP
! source: [K §4.15]
MODULE Demo
    VAR num a;
    PROC main()
        FOR i FROM 1 TO 3 DO
            a := i;
        ENDFOR
        FOR i FROM 3 TO 1 STEP -1 DO
            a := i;
        ENDFOR
    ENDPROC
ENDMODULE
!=== for_bounds
! rule: bounds and step are num
! source: [K §4.15]
MODULE Demo
    VAR num a;
    PROC main()
        FOR i FROM "1" TO 3 DO  ! -> RG307
            a := i;
        ENDFOR
    ENDPROC
ENDMODULE
!=== for_scope
! rule: a loop variable ends with its loop
! source: [K §4.15]
! given: system
MODULE Demo
    VAR num a;
    PROC main()
        FOR i FROM 1 TO 3 DO
            a := i;
        ENDFOR
        a := i;  ! -> RG302
    ENDPROC
ENDMODULE
!=== goto_into
! rule: a GOTO may not enter a block
! source: [K §4.6]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 GOTO inside;  ! -> RG320
        FOR i FROM 1 TO 3 DO
            inside:
            a := i;
        ENDFOR
    ENDPROC
ENDMODULE
!=== goto_into_handler
! rule: a GOTO may not enter a handler
! source: [K §4.6]
MODULE Demo
    PROC main()
        GOTO inside;  ! -> RG320
    ERROR
        inside:
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== goto_other_branch
! rule: a GOTO may not enter another branch
! source: [K §4.6]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 THEN
            GOTO other;  ! -> RG320
        ELSE
            other:
            a := 1;
        ENDIF
    ENDPROC
ENDMODULE
!=== goto_out
! rule: a GOTO may leave a block
! source: [K §4.6]
MODULE Demo
    PROC main()
        FOR i FROM 1 TO 3 DO
            IF i = 2 GOTO out;
        ENDFOR
        out:
    ENDPROC
ENDMODULE
!=== goto_unknown
! rule: a GOTO has its label in the routine
! source: [K §4.3]
MODULE Demo
    PROC main()
        GOTO nowhere;  ! -> RG320
    ENDPROC
ENDMODULE
!=== if
! rule: IF, ELSEIF, ELSE
! source: [K §4.13]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 THEN
            b := 1;
        ELSEIF a = 2 THEN
            b := 2;
        ELSE
            b := 3;
        ENDIF
    ENDPROC
ENDMODULE
!=== if_condition
! rule: a condition is bool
! source: [K §4.13]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a THEN  ! -> RG307
        ENDIF
    ENDPROC
ENDMODULE
!=== if_two_else
! rule: ELSE is the last branch
! source: [K §4.13]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 THEN
        ELSE
        ELSE  ! -> RG201
        ENDIF
    ENDPROC
ENDMODULE
!=== no_break
! rule: there is no statement that leaves a loop: Break is a procedure
! source: [K §4, 11]
MODULE Demo
    PROC main()
        WHILE TRUE DO
            Break;
        ENDWHILE
    ENDPROC
ENDMODULE
!=== return_in_undo
! rule: no RETURN in an UNDO handler
! source: [K §4.7]
MODULE Demo
    PROC main()
    UNDO
        RETURN;  ! -> RG321
    ENDPROC
ENDMODULE
!=== return_type
! rule: the value has the type of the function
! source: [K §4.7]
MODULE Demo
    VAR num a;
    PROC main()
        a := f();
    ENDPROC
    FUNC num f()
        RETURN "1";  ! -> RG307
    ENDFUNC
ENDMODULE
!=== return_value_in_proc
! rule: a PROC returns no value
! source: [K §4.7]
MODULE Demo
    PROC main()
        RETURN 1;  ! -> RG321
    ENDPROC
ENDMODULE
!=== return_without_value
! rule: a FUNC returns a value
! source: [K §4.7]
MODULE Demo
    VAR num a;
    PROC main()
        a := f();
    ENDPROC
    FUNC num f()
        RETURN;  ! -> RG321
    ENDFUNC
ENDMODULE
!=== semicolon
! rule: simple statements end with ;
! source: [K §4.1]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1
        b := 2;  ! -> RG201
    ENDPROC
ENDMODULE
!=== statement_before_case
! rule: a TEST has CASEs only
! source: [K §4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
            a := 1;  ! -> RG201
        CASE 1:
        ENDTEST
    ENDPROC
ENDMODULE
!=== test
! rule: TEST with several values and DEFAULT, any expression as value
! source: [K §4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
        CASE 1, 2:
            a := 3;
        CASE a + 1:
            a := 4;
        DEFAULT:
            a := 5;
        ENDTEST
    ENDPROC
ENDMODULE
!=== test_other_types
! rule: a TEST takes any value type
! source: [K §4.17]
MODULE Demo
    VAR string s;
    VAR pos p;
    PROC main()
        TEST s
        CASE "a":
            TPErase;
        ENDTEST
        TEST p
        CASE [1, 2, 3]:
            TPErase;
        ENDTEST
    ENDPROC
ENDMODULE
!=== test_value_type
! rule: CASE values have the type of the subject
! source: [K §4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
        CASE "1":  ! -> RG307
        ENDTEST
    ENDPROC
ENDMODULE
!=== unreachable
! rule: statements behind RETURN are not reached
! source: [K §4.7]
MODULE Demo
    PROC main()
        RETURN;
        TPErase;  ! -> RG323~
    ENDPROC
ENDMODULE
!=== while
! rule: WHILE
! source: [K §4.16]
MODULE Demo
    VAR num a;
    PROC main()
        WHILE a < 3 DO
            a := a + 1;
        ENDWHILE
    ENDPROC
ENDMODULE
!=== while_without_do
! rule: WHILE has DO
! source: [K §4.16]
MODULE Demo
    VAR num a;
    PROC main()
        WHILE a < 3
            a := a + 1;  ! -> RG201
        ENDWHILE
    ENDPROC
ENDMODULE
