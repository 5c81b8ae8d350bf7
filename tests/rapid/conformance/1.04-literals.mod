!=== aggregate_count
! rule: an aggregate has a member for each component
! source: [K §3.9]
MODULE Demo
    VAR pos p;
    PROC main()
        p := [1, 2];  ! -> RG330
    ENDPROC
ENDMODULE
!=== aggregate_empty
! rule: an aggregate has at least one member
! source: [K §3.9]
MODULE Demo
    VAR pos p;
    PROC main()
        p := [];  ! -> RG201
    ENDPROC
ENDMODULE
!=== aggregate_member_type
! rule: members have the types of the components
! source: [K §3.9]
MODULE Demo
    VAR pos p;
    PROC main()
        p := [1, "2", 3];  ! -> RG307
    ENDPROC
ENDMODULE
!=== aggregate_nested
! rule: aggregates nest, and members may be expressions
! source: [K §3.9]
MODULE Demo
    VAR pose p;
    VAR num a;
    PROC main()
        p := [[a + 1, 2, -a], OrientZYX(0, 0, a)];
    ENDPROC
ENDMODULE
!=== aggregate_type_from_operand
! rule: an aggregate has the type of the other operand
! source: [K §3.9]
MODULE Demo
    VAR bool a;
    VAR pos p;
    PROC main()
        a := p = [1, 2, 3];
        p := p + [0, 0, 1];
    ENDPROC
ENDMODULE
!=== aggregate_type_from_place
! rule: two aggregates with + or - between them have the type of the place
! source: [K §3.9] the type follows from the context; loaded: CalibrateCamera.sys of a YuMi, saved for months [code TechnoX]
MODULE Demo
    VAR pos p;
    VAR num a;
    PROC main()
        p := [a, 2, 3] - [1, 2, 3];
        a := Length([a, 2, 3] + [1, 2, 3]);
        a := [1, 2, 3] - [1, 2, 3];  ! -> RG330
    ENDPROC
    FUNC num Length(pos v)
        RETURN v.x;
    ENDFUNC
ENDMODULE
!=== aggregate_without_type
! rule: two aggregates have no type
! source: [K §3.9]
MODULE Demo
    VAR bool a;
    PROC main()
        a := [1, 2, 3] = [1, 2, 3];  ! -> RG330
    ENDPROC
ENDMODULE
!=== bool
! rule: TRUE and FALSE
! source: [K §2.6]
MODULE Demo
    VAR bool a;
    PROC main()
        a := TRUE;
        a := false;
    ENDPROC
ENDMODULE
!=== constant_expression
! rule: a constant expression has constants and operators
! source: [K §3.1]
MODULE Demo
    CONST num a := 2 * pi;
    VAR num b := a + 1;
    PROC main()
        TPWrite "" \Num:=b;
    ENDPROC
ENDMODULE
!=== constant_expression_call
! rule: no call in a constant expression, at any depth
! source: [K §3.1]
MODULE Demo
    VAR pos b := [1, 2 * Sin(1), 3];  ! -> RG317
    PROC main()
        TPWrite "" \Pos:=b;
    ENDPROC
ENDMODULE
!=== constant_expression_persistent
! rule: no persistent in a constant expression
! source: [K §3.1]
MODULE Demo
    PERS num a := 1;
    VAR num b := a;  ! -> RG317
    PROC main()
        TPWrite "" \Num:=b;
    ENDPROC
ENDMODULE
!=== constant_expression_variable
! rule: no variable in a constant expression
! source: [K §3.1]
MODULE Demo
    VAR num a;
    VAR num b := a + 1;  ! -> RG317
    PROC main()
        TPWrite "" \Num:=b;
    ENDPROC
ENDMODULE
!=== dnum_from_literal
! rule: a literal becomes dnum where dnum is wanted
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum a;
    PROC main()
        a := 4503599627370496;
        a := 1;
    ENDPROC
ENDMODULE
!=== literal_expression
! rule: a PERS starts from literals with signs and aggregates
! source: [K §3.2]
MODULE Demo
    PERS num a := -1;
    PERS pos p := [1, -2, +3];
    VAR num b;
    VAR pos q;
    PROC main()
        b := a;
        q := p;
    ENDPROC
ENDMODULE
!=== literal_expression_call
! rule: a literal expression has no names, operators or calls
! source: [K §3.2]
MODULE Demo
    CONST num c := 1;
    PERS num a := Sin(1);  ! -> RG317
    VAR num b;
    PROC main()
        b := a;
    ENDPROC
ENDMODULE
!=== literal_expression_name
! rule: a literal expression has no names, operators or calls
! source: [K §3.2]
MODULE Demo
    CONST num c := 1;
    PERS num a := c;  ! -> RG317
    VAR num b;
    PROC main()
        b := a;
    ENDPROC
ENDMODULE
!=== literal_expression_operator
! rule: a literal expression has no names, operators or calls
! source: [K §3.2]
MODULE Demo
    CONST num c := 1;
    PERS num a := 1 + 2;  ! -> RG317
    VAR num b;
    PROC main()
        b := a;
    ENDPROC
ENDMODULE
!=== literal_expression_pi
! rule: a literal expression has no names, operators or calls
! source: [K §3.2]
MODULE Demo
    CONST num c := 1;
    PERS num a := pi;  ! -> RG317
    VAR num b;
    PROC main()
        b := a;
    ENDPROC
ENDMODULE
!=== number_bare_exponent
! rule: an exponent has digits
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1E;  ! -> RG205
    ENDPROC
ENDMODULE
!=== number_beyond_every_type
! rule: an exponent out of range is an error of the text
! source: [K §1.4, 2.5]
MODULE Demo
    PROC main()
        elsewhere := 2E52786;  ! -> RG205
    ENDPROC
ENDMODULE
!=== number_exponent
! rule: numbers such as 3E2
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 3E2;
    ENDPROC
ENDMODULE
!=== number_fraction
! rule: numbers such as 3.5
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 3.5;
    ENDPROC
ENDMODULE
!=== number_integer
! rule: numbers such as 3
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 3;
    ENDPROC
ENDMODULE
!=== number_negative_exponent
! rule: numbers such as 2.5E-3
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 2.5E-3;
    ENDPROC
ENDMODULE
!=== number_not_exact
! rule: whole numbers above 8388608 are not all exact
! source: [K §2.13]
MODULE Demo
    VAR num a;
    PROC main()
        a := 16777217;  ! -> RG319?
    ENDPROC
ENDMODULE
!=== number_out_of_range
! rule: a num literal fits single precision
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1E39;  ! -> RG319
    ENDPROC
ENDMODULE
!=== number_point_first
! rule: numbers such as .27
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := .27;
    ENDPROC
ENDMODULE
!=== number_point_last
! rule: numbers such as 38.
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 38.;
    ENDPROC
ENDMODULE
!=== number_prefixes
! rule: 0x, 0o and 0b numbers
! source: [code] intellij-rapid
MODULE Demo
    VAR num a;
    PROC main()
        a := 0x1F + 0o17 + 0b101;
    ENDPROC
ENDMODULE
!=== number_prefixes_early
! rule: prefixed numbers are not in RobotWare 5.0
! source: [K §2.5]
! robotware: 5.0
MODULE Demo
    VAR num a;
    PROC main()
        a := 0x1F;  ! -> RG205
    ENDPROC
ENDMODULE
!=== number_small_e
! rule: numbers such as 2e+3
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 2e+3;
    ENDPROC
ENDMODULE
!=== number_two_points
! rule: a number has one point
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1.2.3;  ! -> RG205
    ENDPROC
ENDMODULE
!=== placeholder_alt
! rule: <ALT> stands for an alternative parameter
! source: [K §2.9, 5.1]
MODULE Demo
    PROC p(\num a | <ALT>)
    ENDPROC
ENDMODULE
!=== placeholder_arg
! rule: <ARG> stands for an argument
! source: [K §2.9, 4.5]
MODULE Demo
    PROC main()
        TPWrite <ARG>;
    ENDPROC
ENDMODULE
!=== placeholder_cse
! rule: <CSE> stands for a CASE branch
! source: [K §2.9, 4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
        <CSE>
        DEFAULT:
        ENDTEST
    ENDPROC
ENDMODULE
!=== placeholder_ddn
! rule: <DDN> stands for a data declaration
! source: [K §2.9]
MODULE Demo
    <DDN>
ENDMODULE
!=== placeholder_dim
! rule: <DIM> stands for the dimensions of a parameter
! source: [K §2.9, 5.1]
MODULE Demo
    PROC p(num a{<DIM>})
    ENDPROC
ENDMODULE
!=== placeholder_eit
! rule: <EIT> stands for an ELSEIF branch
! source: [K §2.9, 4.13]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 THEN
            a := 2;
            <EIT>
        ENDIF
    ENDPROC
ENDMODULE
!=== placeholder_exp
! rule: <EXP> stands for an expression
! source: [K §2.9, 3]
MODULE Demo
    VAR num a;
    PROC main()
        a := <EXP>;
    ENDPROC
ENDMODULE
!=== placeholder_id
! rule: <ID> stands for a name
! source: [K §2.3, 2.9]
MODULE Demo
    VAR num <ID>;
    PROC main()
        <ID>;
        <ID>:
        GOTO <ID>;
    ENDPROC
ENDMODULE
!=== placeholder_id_in_calls
! rule: <ID> stands for a name in the arguments of a procedure, not of a function
! source: [K §2.9, 3.10, 4.5]
MODULE Demo
    RECORD r
        <ID> x;
    ENDRECORD
    VAR num a;
    PROC main()
        TPWrite "x" \<ID>:=1;
        TPWrite <ID>:="x";
        own <ID>:=1 \<ID>?<ID>;
        a := Abs(\<ID>);  ! -> RG201
    ENDPROC
ENDMODULE
!=== placeholder_id_is_no_datum
! rule: <ID> does not stand for a component
! source: [K §3.5]
MODULE Demo
    VAR num a;
    VAR pos p;
    PROC main()
        a := p.<ID>;  ! -> RG201
    ENDPROC
ENDMODULE
!=== placeholder_par
! rule: <PAR> stands for a parameter
! source: [K §2.9, 5.1]
MODULE Demo
    PROC p(<PAR>)
    ENDPROC
ENDMODULE
!=== placeholder_rdn
! rule: <RDN> stands for a routine
! source: [K §2.9]
MODULE Demo
    <RDN>
ENDMODULE
!=== placeholder_smt
! rule: <SMT> stands for a statement, also in a compact IF
! source: [K §2.9, 4]
MODULE Demo
    VAR num a;
    PROC main()
        <SMT>
        IF a = 1 <SMT>
    ENDPROC
ENDMODULE
!=== placeholder_tdn
! rule: <TDN> stands for a type definition
! source: [K §2.9]
MODULE Demo
    <TDN>
ENDMODULE
!=== placeholder_var
! rule: <VAR> stands for a datum
! source: [K §2.9, 4.4]
MODULE Demo
    PROC main()
        <VAR> := 1;
    ENDPROC
ENDMODULE
!=== predefined_data
! rule: predefined constants are there
! source: [code] rapid-for-vim
MODULE Demo
    VAR num a;
    PROC main()
        a := pi + EOF_BIN + EOF_NUM + WAIT_MAX + ERRNO + INTNO;
        TPWrite EOF + stEmpty + STR_DIGIT;
    ENDPROC
ENDMODULE
!=== star
! rule: * in place of a position
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        MoveL *, v100, fine, tool0;
    ENDPROC
ENDMODULE
!=== string_80
! rule: a string has up to 80 characters
! source: [K §2.13]
MODULE Demo
    PROC main()
        TPWrite "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx";
    ENDPROC
ENDMODULE
!=== string_80_after_escapes
! rule: the 80 are counted behind escapes
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41\41";
    ENDPROC
ENDMODULE
!=== string_81
! rule: a string of 81 characters is too long
! source: [K §2.13]
MODULE Demo
    PROC main()
        TPWrite "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx";  ! -> RG319
    ENDPROC
ENDMODULE
!=== string_backslash
! rule: a backslash in a string is written twice
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "a\\b";
    ENDPROC
ENDMODULE
!=== string_code
! rule: a backslash and two hexadecimal digits are a byte
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "\0D\0a";
    ENDPROC
ENDMODULE
!=== string_lone_backslash
! rule: a lone backslash is an error
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "a\z";  ! -> RG206
    ENDPROC
ENDMODULE
!=== string_one_digit
! rule: one hexadecimal digit is not enough
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "\0";  ! -> RG206
    ENDPROC
ENDMODULE
!=== string_over_lines
! rule: a string ends on its line
! source: [K §2.7]
! at 7: RG207
! at 8: RG207
MODULE Demo
    PROC main()
        TPWrite "abc
        def";
        TPErase;
    ENDPROC
ENDMODULE
!=== string_quote
! rule: a quote in a string is written twice
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "a ""b"" c";
    ENDPROC
ENDMODULE
!=== string_with_tab
! rule: a tab in a string is written as a code
! source: [K §2.1, 2.7]
MODULE Demo
    PROC main()
        TPWrite "a	b";  ! -> RG206?
    ENDPROC
ENDMODULE
