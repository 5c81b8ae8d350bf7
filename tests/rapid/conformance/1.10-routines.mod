!=== alternatives
! rule: alternatives share one backslash, one may be given
! source: [K §5.1]
MODULE Demo
    PROC main()
        p \a:=1;
        p \b:="x";
        p \c;
        p;
        p \a:=1 \c;  ! -> RG313
    ENDPROC
    PROC p(\num a | string b | switch c)
        IF Present(a) OR Present(b) OR Present(c) TPErase;
    ENDPROC
ENDMODULE
!=== alternatives_with_two_backslashes
! rule: alternatives have one backslash
! source: [K §5.1]
MODULE Demo
    PROC p(\num a | \num b)  ! -> RG201
    ENDPROC
ENDMODULE
!=== backward_in_func
! rule: a FUNC has no BACKWARD handler
! source: [K §5.4]
MODULE Demo
    FUNC num f()
        RETURN 1;
    BACKWARD  ! -> RG216
    ENDFUNC
ENDMODULE
!=== backward_in_trap
! rule: a TRAP has no BACKWARD handler
! source: [K §5.5]
MODULE Demo
    TRAP t
    BACKWARD  ! -> RG216
    ENDTRAP
ENDMODULE
!=== data_first
! rule: data come before statements
! source: [K §5.3]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1;
        VAR num c;  ! -> RG213
        c := a;
        b := c;
    ENDPROC
ENDMODULE
!=== element_and_component_of_persistent
! rule: elements and components of a persistent are persistent
! source: [K §3.6]
MODULE Demo
    PERS num a{2} := [1, 2];
    PERS pos b := [1, 2, 3];
    PROC main()
        p a{1};
        p b.x;
    ENDPROC
    PROC p(PERS num n)
        n := 1;
    ENDPROC
ENDMODULE
!=== function_needs_return
! rule: a FUNC has a RETURN
! source: [K §5.4, 12]
MODULE Demo
    VAR num a;
    PROC main()
        a := f();
    ENDPROC
    FUNC num f()  ! -> RG322?
    ENDFUNC
ENDMODULE
!=== function_of_array
! rule: a FUNC returns no array
! source: [K §5.4]
MODULE Demo
    FUNC num{3} f()  ! -> RG201
        RETURN 1;
    ENDFUNC
ENDMODULE
!=== function_of_non_value
! rule: a FUNC returns a value type
! source: [K §5.4]
MODULE Demo
    PROC main()
    ENDPROC
    FUNC clock f()  ! -> RG309
        RETURN 1;
    ENDFUNC
ENDMODULE
!=== function_of_signal
! rule: a FUNC returns no semivalue type
! source: [K §2.16]
MODULE Demo
    FUNC signaldi f()  ! -> RG309
        EXIT;
    ENDFUNC
ENDMODULE
!=== function_return_on_all_ways
! rule: a FUNC returns on every way
! source: [K §5.4]
MODULE Demo
    VAR num a;
    PROC main()
        a := f(1);
    ENDPROC
    FUNC num f(num x)  ! -> RG322~
        IF x > 0 RETURN 1;
    ENDFUNC
ENDMODULE
!=== handlers
! rule: BACKWARD, ERROR, UNDO in this order
! source: [K §5.3]
MODULE Demo
    PROC main()
        TPErase;
    BACKWARD
        TPErase;
    ERROR
        TRYNEXT;
    UNDO
        TPErase;
    ENDPROC
ENDMODULE
!=== handlers_order
! rule: ERROR comes before UNDO
! source: [K §5.3]
MODULE Demo
    PROC main()
    UNDO
        TPErase;
    ERROR  ! -> RG216
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== handlers_twice
! rule: at most one handler of a kind
! source: [K §5.3]
MODULE Demo
    PROC main()
    ERROR
        TRYNEXT;
    ERROR  ! -> RG216
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== in_takes_expressions
! rule: an IN parameter takes any expression and may be assigned
! source: [K §5.1]
MODULE Demo
    PROC main()
        p 1 + 2;
    ENDPROC
    PROC p(num a)
        a := a + 1;
    ENDPROC
ENDMODULE
!=== inout_refuses_constant
! rule: a constant as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p c;  ! -> RG315
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_refuses_errno
! rule: a errno as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p ERRNO;  ! -> RG315
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_refuses_expression
! rule: a expression as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p 1 + 1;  ! -> RG315
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_refuses_loop_variable
! rule: a loop variable as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        FOR i FROM 1 TO 2 DO
            p i;  ! -> RG315
        ENDFOR
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_component
! rule: a component as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p q.x;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_element
! rule: a element as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p e{1};
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_in_parameter
! rule: an IN parameter as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(num x)
        p x;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_inout_parameter
! rule: an INOUT parameter as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(INOUT num x)
        p x;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_pers_parameter
! rule: an PERS parameter as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(PERS num x)
        p x;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_persistent
! rule: a persistent as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p s;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_var_parameter
! rule: an VAR parameter as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(VAR num x)
        p x;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== inout_takes_variable
! rule: a variable as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p v;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
!=== nested
! rule: routines do not nest
! source: [K §5]
MODULE Demo
    PROC a()
    PROC b()  ! -> RG202
    ENDPROC
ENDMODULE
!=== non_value_in_parameter
! rule: non-value types are VAR parameters
! source: [K §2.16]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(clock c)  ! -> RG328
    ENDPROC
ENDMODULE
!=== non_value_inout_parameter
! rule: non-value types are VAR parameters
! source: [K §2.16]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(INOUT clock c)  ! -> RG328
    ENDPROC
ENDMODULE
!=== non_value_pers_parameter
! rule: non-value types are VAR parameters
! source: [K §2.16]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(PERS clock c)  ! -> RG328
    ENDPROC
ENDMODULE
!=== optional_with_and_without_comma
! rule: a comma before an optional parameter is free
! source: [K §5.1]
MODULE Demo
    PROC main()
        p 1 \b:=2 \c:=3;
    ENDPROC
    PROC p(num a \num b, \num c)
        IF Present(b) AND Present(c) a := b + c;
    ENDPROC
ENDMODULE
!=== parameter_commas
! rule: a comma stands between required parameters, and before none
! source: [K §5.1]
MODULE Demo
    PROC leading(, num a)  ! -> RG201
    ENDPROC
    PROC missing(num a num b)  ! -> RG201
    ENDPROC
    PROC main()
    ENDPROC
ENDMODULE
!=== pers_refuses_component
! rule: a component as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p q.x;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_constant
! rule: a constant as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p c;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_element
! rule: a element as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p e{1};  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_errno
! rule: a errno as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p ERRNO;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_expression
! rule: a expression as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p 1 + 1;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_in_parameter
! rule: an IN parameter as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(num x)
        p x;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_loop_variable
! rule: a loop variable as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        FOR i FROM 1 TO 2 DO
            p i;  ! -> RG315
        ENDFOR
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_var_parameter
! rule: an VAR parameter as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(VAR num x)
        p x;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_refuses_variable
! rule: a variable as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p v;  ! -> RG315
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_takes_inout_parameter
! rule: an INOUT parameter as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(INOUT num x)
        p x;
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_takes_pers_parameter
! rule: an PERS parameter as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(PERS num x)
        p x;
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== pers_takes_persistent
! rule: a persistent as argument of a PERS parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p s;
    ENDPROC
    PROC p(PERS num a)
        a := a;
    ENDPROC
ENDMODULE
!=== required_behind_optional
! rule: a comma stands before a required parameter
! source: [K §5.1]
MODULE Demo
    PROC p(\num a num b)  ! -> RG201
    ENDPROC
ENDMODULE
!=== signal_parameter
! rule: signals are VAR parameters
! source: [K §2.16]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(VAR signaldo s)
        SetDO s, 1;
    ENDPROC
    PROC q(signaldo s)  ! -> RG328
    ENDPROC
ENDMODULE
!=== switch_datum
! rule: no datum is a switch
! source: [K §5.1]
MODULE Demo
    VAR switch a;  ! -> RG303
ENDMODULE
!=== switch_required
! rule: a switch is an optional parameter
! source: [K §5.1]
MODULE Demo
    PROC p(switch a)  ! -> RG328
    ENDPROC
ENDMODULE
!=== trap_is_not_called
! rule: a trap is started by its interrupt only
! source: [K §5]
MODULE Demo
    PROC main()
        t;  ! -> RG306
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
!=== trap_without_parameters
! rule: a TRAP has no parameters
! source: [K §5.5]
MODULE Demo
    TRAP t()  ! -> RG201
    ENDTRAP
ENDMODULE
!=== var_refuses_constant
! rule: a constant as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p c;  ! -> RG315
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_refuses_errno
! rule: a errno as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p ERRNO;  ! -> RG315
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_refuses_expression
! rule: a expression as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p 1 + 1;  ! -> RG315
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_refuses_loop_variable
! rule: a loop variable as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        FOR i FROM 1 TO 2 DO
            p i;  ! -> RG315
        ENDFOR
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_refuses_pers_parameter
! rule: an PERS parameter as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(PERS num x)
        p x;  ! -> RG315
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_refuses_persistent
! rule: a persistent as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p s;  ! -> RG315
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_takes_component
! rule: a component as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p q.x;
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_takes_element
! rule: a element as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p e{1};
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_takes_in_parameter
! rule: an IN parameter as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(num x)
        p x;
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_takes_inout_parameter
! rule: an INOUT parameter as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(INOUT num x)
        p x;
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_takes_var_parameter
! rule: an VAR parameter as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC outer(VAR num x)
        p x;
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== var_takes_variable
! rule: a variable as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p v;
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
!=== wrong_end
! rule: a routine ends with its own word
! source: [K §5.3, 5.4]
MODULE Demo
    PROC p()
    ENDFUNC  ! -> RG201
ENDMODULE
