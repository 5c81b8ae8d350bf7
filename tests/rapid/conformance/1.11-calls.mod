!=== argument_type
! rule: an argument has the type of its parameter
! source: [K §3.10, 5.1]
MODULE Demo
    PROC main()
        p "1";  ! -> RG307
    ENDPROC
    PROC p(num a)
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
!=== comma_before_first
! rule: no comma stands before the first argument
! source: [K §3.10, 4.5]
MODULE Demo
    VAR num a;
    PROC main()
        TPWrite , "x";  ! -> RG201
        a := Abs(, 1);  ! -> RG201
    ENDPROC
ENDMODULE
!=== comma_before_optional
! rule: a comma before an optional argument is free
! source: [K §3.10] [code] abb_driver
MODULE Demo
    VAR socketdev s;
    VAR rawbytes b;
    PROC main()
        SocketReceive s, \RawData:=b, \Time:=5;
        SocketReceive s \RawData:=b \Time:=5;
    ENDPROC
ENDMODULE
!=== comma_before_required
! rule: a comma stands before a required argument
! source: [K §3.10]
MODULE Demo
    PROC main()
        ErrWrite \W "a", "b";  ! -> RG201
    ENDPROC
ENDMODULE
!=== conditional
! rule: an optional parameter is handed on with ?
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \a:=1;
    ENDPROC
    PROC p(\num a \switch s)
        q \a?a \s?s;
    ENDPROC
    PROC q(\num a \switch s)
        IF Present(a) OR Present(s) TPErase;
    ENDPROC
ENDMODULE
!=== conditional_alternatives
! rule: several conditional arguments may serve alternatives
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \a:=1;
    ENDPROC
    PROC p(\num a \string b)
        q \a?a \b?b;
    ENDPROC
    PROC q(\num a | string b)
        IF Present(a) OR Present(b) TPErase;
    ENDPROC
ENDMODULE
!=== conditional_required
! rule: a required parameter is not handed on with ?
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1;
    ENDPROC
    PROC p(num a)
        q \a?a;  ! -> RG316
    ENDPROC
    PROC q(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
!=== conditional_type
! rule: an optional parameter is handed on to its type
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \a:=1;
    ENDPROC
    PROC p(\num a)
        q \a?a;  ! -> RG307
    ENDPROC
    PROC q(\string a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
!=== function_parentheses
! rule: a function has parentheses
! source: [K §3.10]
MODULE Demo
    VAR num a;
    PROC main()
        a := f;  ! -> RG306
        a := f();
    ENDPROC
    FUNC num f()
        RETURN 1;
    ENDFUNC
ENDMODULE
!=== late_binding
! rule: a procedure by its name in a string
! source: [K §4.5]
MODULE Demo
    VAR string a;
    PROC main()
        %"p"% 1;
        %"p" + a% 1 \b:=2;
        %":p"% 1;
    ENDPROC
    PROC p(num n \num b)
        IF Present(b) TPWrite "" \Num:=n;
    ENDPROC
ENDMODULE
!=== late_binding_arguments
! rule: arguments of a procedure whose name is known
! source: [K §4.5]
MODULE Demo
    CONST string NAME := "p";
    PROC main()
        %"p"% "x";  ! -> RG307?
        %"p"%;  ! -> RG311?
        %NAME% 1;
        %"f"%;  ! -> RG306?
    ENDPROC
    PROC p(num n)
        TPWrite "" \Num:=n + f();
    ENDPROC
    FUNC num f()
        RETURN 1;
    ENDFUNC
ENDMODULE
!=== late_binding_of_function
! rule: functions are not bound late
! source: [K §4.5]
MODULE Demo
    VAR num a;
    FUNC num f()
        RETURN 1;
    ENDFUNC
    PROC main()
        a := %"f"%();  ! -> RG201
        a := f();
    ENDPROC
ENDMODULE
!=== late_binding_of_number
! rule: the name is a string
! source: [K §4.5]
MODULE Demo
    PROC main()
        %1%;  ! -> RG307
    ENDPROC
ENDMODULE
!=== late_binding_unknown
! rule: a name that no procedure has
! source: [K §4.5, 12]
! given: system
MODULE Demo
    PROC main()
        %"nothing"%;  ! -> RG301?
        %":nothing"%;  ! -> RG301?
        %"other:thing"%;
    ENDPROC
ENDMODULE
!=== leading_optional
! rule: a leading switch is followed by a comma
! source: [K §4.5]
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PROC main()
        MoveL \Conc, p, v100, fine, tool0;
    ENDPROC
ENDMODULE
!=== missing
! rule: each required parameter has an argument
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1;  ! -> RG311
    ENDPROC
    PROC p(num a, num b)
        TPWrite "" \Num:=a + b;
    ENDPROC
ENDMODULE
!=== named_required
! rule: a required argument may be named
! source: [K §3.10]
MODULE Demo
    PROC main()
        p a:=1, b:=2;
        p 1, b:=2;
    ENDPROC
    PROC p(num a, num b)
        TPWrite "" \Num:=a + b;
    ENDPROC
ENDMODULE
!=== names_do_not_reorder
! rule: named arguments keep the order of the parameters
! source: [K §3.10]
MODULE Demo
    PROC main()
        p b:=2, a:=1;  ! -> RG314
    ENDPROC
    PROC p(num a, num b)
        TPWrite "" \Num:=a + b;
    ENDPROC
ENDMODULE
!=== no_parentheses
! rule: a procedure is called without parentheses
! source: [K §4.5]
MODULE Demo
    PROC main()
        p();  ! -> RG201
    ENDPROC
    PROC p()
    ENDPROC
ENDMODULE
!=== optional_is_named
! rule: an optional argument is named
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1;  ! -> RG311
    ENDPROC
    PROC p(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
!=== optional_order
! rule: optional arguments keep the order of the parameters
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \b:=2 \a:=1;  ! -> RG314
    ENDPROC
    PROC p(\num a \num b)
        IF Present(a) AND Present(b) TPErase;
    ENDPROC
ENDMODULE
!=== parentheses_round_an_argument
! rule: an argument may be in parentheses
! source: [K §3.10, 4.5]
MODULE Demo
    PROC main()
        TPWrite ("x");
        WaitTime (1);
    ENDPROC
ENDMODULE
!=== switch_with_value
! rule: a switch takes no value
! source: [K §5.1]
MODULE Demo
    PROC main()
        p \s:=TRUE;  ! -> RG312
    ENDPROC
    PROC p(\switch s)
        IF Present(s) TPErase;
    ENDPROC
ENDMODULE
!=== too_many
! rule: no argument without a parameter
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1, 2;  ! -> RG311
    ENDPROC
    PROC p(num a)
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
!=== unknown_optional
! rule: an optional argument has its parameter
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \b:=1;  ! -> RG312
    ENDPROC
    PROC p(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
!=== value_missing
! rule: an optional argument that is no switch has a value
! source: [K §5.1]
MODULE Demo
    PROC main()
        p \a;  ! -> RG312
    ENDPROC
    PROC p(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
