!=== bare_global_persistent
! rule: a global PERS may lack an initial value
! source: [K §2.23]
MODULE Demo
    PERS tooldata t;
ENDMODULE
!=== bare_local_persistent
! rule: a LOCAL PERS has an initial value
! source: [K §2.23]
MODULE Demo
    LOCAL PERS num a;  ! -> RG317
ENDMODULE
!=== bare_task_persistent
! rule: a TASK PERS has an initial value
! source: [K §2.23]
MODULE Demo
    TASK PERS num a;  ! -> RG317
ENDMODULE
!=== constant_needs_value
! rule: a CONST has a value
! source: [K §2.24]
MODULE Demo
    CONST num a;  ! -> RG201
ENDMODULE
!=== constant_of_value_type
! rule: a CONST is of a value type
! source: [K §2.24]
MODULE Demo
    CONST socketdev a := 0;  ! -> RG309
ENDMODULE
!=== dimensions
! rule: one to three dimensions, of constant sizes
! source: [K §2.22]
MODULE Demo
    CONST num n := 2;
    VAR num a{n};
    VAR num b{n, 2 * n};
    VAR num c{1, 2, 3};
ENDMODULE
!=== four_dimensions
! rule: no fourth dimension
! source: [K §2.22]
MODULE Demo
    VAR num a{1, 2, 3, 4};  ! -> RG318
ENDMODULE
!=== initial_sizes
! rule: an initial value has the declared sizes
! source: [K §2.22]
MODULE Demo
    VAR num a{3} := [1, 2, 3];
    VAR num b{2, 2} := [[1, 2], [3, 4]];
    VAR num c{3} := [1, 2];  ! -> RG318
    VAR num d{2, 2} := [[1, 2], [3]];  ! -> RG318
ENDMODULE
!=== initial_value_type
! rule: an initial value has the type of its datum
! source: [K §2.22]
MODULE Demo
    VAR num a := TRUE;  ! -> RG307
    PROC main()
        a := 1;
    ENDPROC
ENDMODULE
!=== local_and_task
! rule: LOCAL and TASK exclude each other
! source: [K §2.18]
MODULE Demo
    LOCAL TASK VAR num a;  ! -> RG201
ENDMODULE
!=== non_value_initial
! rule: a non-value type takes no initial value
! source: [K §2.22]
MODULE Demo
    VAR clock c := 0;  ! -> RG309
ENDMODULE
!=== persistent_in_a_routine
! rule: a PERS belongs to a module
! source: [K §2.18]
MODULE Demo
    PROC main()
        PERS num a := 1;  ! -> RG329
        a := 2;
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
!=== persistent_of_value_type
! rule: a PERS is of a value type
! source: [K §2.23]
MODULE Demo
    PERS rawbytes a;  ! -> RG309
ENDMODULE
!=== reference_ahead
! rule: data of a module are known in the whole module
! source: [K §2.20]
MODULE Demo
    VAR num a := b;
    CONST num b := 2;
    PROC main()
        a := later();
    ENDPROC
    FUNC num later()
        RETURN a;
    ENDFUNC
ENDMODULE
!=== routine_constant
! rule: a routine has constants
! source: [K §2.18]
MODULE Demo
    PROC main()
        CONST num a := 1;
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
!=== routine_variable_from_parameter
! rule: a VAR of a routine starts from a constant expression
! source: [K §2.22]
MODULE Demo
    PROC main()
        p 1;
    ENDPROC
    PROC p(num n)
        VAR num a := n;  ! -> RG317
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
!=== size_fraction
! rule: a size is whole
! source: [K §2.22]
MODULE Demo
    VAR num a{1.5};  ! -> RG318
ENDMODULE
!=== size_variable
! rule: a size is a constant expression
! source: [K §2.22]
MODULE Demo
    VAR num n := 2;
    VAR num a{n};  ! -> RG317
ENDMODULE
!=== size_zero
! rule: a size is at least 1
! source: [K §2.22]
MODULE Demo
    VAR num a{0};  ! -> RG318
ENDMODULE
!=== task_const
! rule: there is no TASK CONST
! source: [K §2.18]
MODULE Demo
    TASK CONST num a := 1;  ! -> RG201
ENDMODULE
!=== task_routine
! rule: there is no TASK routine
! source: [K §5.3]
MODULE Demo
    TASK PROC a()  ! -> RG201
    ENDPROC
ENDMODULE
!=== task_var
! rule: TASK VAR and TASK PERS
! source: [K §2.18]
MODULE Demo
    TASK VAR num a;
    TASK PERS num b := 1;
ENDMODULE
