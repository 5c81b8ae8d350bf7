!=== predefined_names_are_ordinary
! rule: predefined names may be declared anew
! source: [K §2.12, 2.20, 5.2]
MODULE Demo
    VAR num a;
    PROC main()
        VAR num Stop;
        Stop := 1;
        a := Stop;
    ENDPROC
ENDMODULE
!=== ref_is_for_builtins
! rule: REF parameters exist in predefined routines only
! source: [K §5.1]
MODULE Demo
    PROC p(REF num a)  ! -> RG201
    ENDPROC
ENDMODULE
!=== reserved_alias
! rule: ALIAS is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num alias;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_and
! rule: AND is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num and;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_backward
! rule: BACKWARD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num backward;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_case
! rule: CASE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num case;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_connect
! rule: CONNECT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num connect;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_const
! rule: CONST is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num const;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_default
! rule: DEFAULT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num default;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_div
! rule: DIV is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num div;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_do
! rule: DO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num do;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_else
! rule: ELSE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num else;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_elseif
! rule: ELSEIF is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num elseif;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endfor
! rule: ENDFOR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endfor;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endfunc
! rule: ENDFUNC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endfunc;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endif
! rule: ENDIF is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endif;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endmodule
! rule: ENDMODULE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endmodule;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endproc
! rule: ENDPROC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endproc;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endrecord
! rule: ENDRECORD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endrecord;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endtest
! rule: ENDTEST is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endtest;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endtrap
! rule: ENDTRAP is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endtrap;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_endwhile
! rule: ENDWHILE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endwhile;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_error
! rule: ERROR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num error;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_exit
! rule: EXIT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num exit;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_false
! rule: FALSE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num false;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_for
! rule: FOR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num for;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_from
! rule: FROM is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num from;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_func
! rule: FUNC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num func;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_goto
! rule: GOTO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num goto;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_if
! rule: IF is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num if;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_inout
! rule: INOUT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num inout;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_local
! rule: LOCAL is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num local;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_mod
! rule: MOD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num mod;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_module
! rule: MODULE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num module;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_nostepin
! rule: NOSTEPIN is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num nostepin;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_not
! rule: NOT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num not;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_noview
! rule: NOVIEW is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num noview;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_or
! rule: OR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num or;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_pers
! rule: PERS is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num pers;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_proc
! rule: PROC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num proc;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_raise
! rule: RAISE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num raise;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_readonly
! rule: READONLY is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num readonly;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_record
! rule: RECORD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num record;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_retry
! rule: RETRY is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num retry;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_return
! rule: RETURN is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num return;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_step
! rule: STEP is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num step;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_sysmodule
! rule: SYSMODULE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num sysmodule;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_task
! rule: TASK is reserved
! source: [K §2.18]
MODULE Demo
    RECORD r
        num task;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_test
! rule: TEST is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num test;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_then
! rule: THEN is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num then;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_to
! rule: TO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num to;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_trap
! rule: TRAP is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num trap;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_true
! rule: TRUE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num true;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_trynext
! rule: TRYNEXT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num trynext;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_undo
! rule: UNDO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num undo;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_var
! rule: VAR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num var;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_viewonly
! rule: VIEWONLY is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num viewonly;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_while
! rule: WHILE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num while;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_with
! rule: WITH is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num with;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== reserved_xor
! rule: XOR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num xor;  ! -> RG201
    ENDRECORD
ENDMODULE
!=== switch_is_no_word
! rule: switch is a type name, not reserved
! source: [K §2.4, 5.1]
MODULE Demo
    VAR num switch;
    VAR num a;
    PROC main()
        switch := 1;
        a := switch;
    ENDPROC
ENDMODULE
