!=== label_and_datum
! rule: a label and a datum of one routine differ
! source: [K §4.3]
MODULE Demo
    PROC main()
        VAR num a;
        a:  ! -> RG305
        a := 1;
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
!=== letter_first
! rule: a name starts with a letter
! source: [K §2.3]
MODULE Demo
    PROC main()
        _a := 1;  ! -> RG204
    ENDPROC
ENDMODULE
!=== local_hides_builtin
! rule: a module may declare a predefined name
! source: [K §2.12]
MODULE Demo
    PROC main()
        StrLen;
    ENDPROC
    PROC StrLen()
    ENDPROC
ENDMODULE
!=== loop_variable_hides
! rule: a loop variable hides other names to its ENDFOR
! source: [K §4.15]
MODULE Demo
    VAR string a;
    VAR num b;
    PROC main()
        FOR a FROM 1 TO 3 DO
            b := a;
        ENDFOR
        a := "x";
        TPWrite a;
    ENDPROC
ENDMODULE
!=== module_and_global
! rule: a module and a global object of its task differ
! source: [K §2.12]
! given: system
! at 8: RG305
MODULE Demo
    PROC main()
    ENDPROC
    PROC Demo()
    ENDPROC
ENDMODULE
!=== module_hides_predefined
! rule: the name of a module hides a predefined object
! source: [K §9.1]
MODULE Stop
    PROC main()
        Stop;  ! -> RG306
    ENDPROC
ENDMODULE
!=== name_of_32
! rule: a name has up to 32 characters
! source: [K §2.3]
MODULE Demo
    VAR num nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn;
    PROC main()
        nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn := 1;
    ENDPROC
ENDMODULE
!=== name_of_33
! rule: a name of 33 characters is too long
! source: [K §2.3]
MODULE Demo
    VAR num nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn;  ! -> RG220
    PROC main()
        nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn := 1;
    ENDPROC
ENDMODULE
!=== parameter_and_datum
! rule: a parameter counts as a datum of its routine
! source: [K §5.2]
MODULE Demo
    PROC main()
        p 1;
    ENDPROC
    PROC p(num a)
        VAR num a;  ! -> RG305
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
!=== routine_datum_hides_module_datum
! rule: routine data hide module data
! source: [K §2.20]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        VAR string a;
        a := "x";
        TPWrite a;
        b := 1;
    ENDPROC
ENDMODULE
!=== two_data_of_a_routine
! rule: data of one routine have different names
! source: [K §2.20]
MODULE Demo
    VAR num b;
    PROC main()
        VAR num a;
        VAR num A;  ! -> RG305
        a := 1;
        b := a;
    ENDPROC
ENDMODULE
!=== two_labels
! rule: labels of one routine have different names
! source: [K §4.3]
MODULE Demo
    PROC main()
        again:
        again:  ! -> RG305
        GOTO again;
    ENDPROC
ENDMODULE
!=== two_objects_of_a_module
! rule: objects of one module have different names
! source: [K §2.12]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1;
    ENDPROC
    LOCAL PROC a()  ! -> RG305
    ENDPROC
ENDMODULE
