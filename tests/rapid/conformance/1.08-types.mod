!=== alias_equals_base
! rule: an alias and its base are one type
! source: [K §2.15, 2.17]
MODULE Demo
    ALIAS num level;
    VAR level a;
    VAR num b;
    VAR errnum c;
    PROC main()
        a := b;
        b := a + c;
        c := a;
    ENDPROC
ENDMODULE
!=== alias_of_alias
! rule: an alias names no alias
! source: [K §2.15]
MODULE Demo
    ALIAS num a;
    ALIAS a b;  ! -> RG327
ENDMODULE
!=== alias_of_builtin_alias
! rule: errnum is an alias too
! source: [K §2.15]
MODULE Demo
    ALIAS errnum a;  ! -> RG327
ENDMODULE
!=== no_conversion
! rule: nothing is converted
! source: [K §2.17]
MODULE Demo
    VAR num a;
    VAR dnum b;
    PROC main()
        a := b;  ! -> RG307
    ENDPROC
ENDMODULE
!=== non_value_assigned
! rule: a non-value is not assigned
! source: [K §2.16]
MODULE Demo
    VAR clock c;
    VAR clock d;
    PROC main()
        c := d;  ! -> RG309
    ENDPROC
ENDMODULE
!=== non_value_compared
! rule: a non-value is not compared
! source: [K §2.16]
MODULE Demo
    VAR rawbytes c;
    VAR rawbytes d;
    PROC main()
        IF c = d THEN  ! -> RG309 RG309
        ENDIF
    ENDPROC
ENDMODULE
!=== record_array
! rule: a component is no array
! source: [K §2.14]
MODULE Demo
    RECORD r
        num x{3};  ! -> RG201
    ENDRECORD
ENDMODULE
!=== record_empty
! rule: a record has at least one component
! source: [K §2.14]
MODULE Demo
    RECORD r
    ENDRECORD  ! -> RG201
ENDMODULE
!=== record_in_itself
! rule: a record does not contain itself
! source: [K §2.14]
MODULE Demo
    RECORD r
        r x;  ! -> RG327
    ENDRECORD
ENDMODULE
!=== record_non_value
! rule: a non-value component makes the record non-value
! source: [K §2.16] [code] abb_driver
MODULE Demo
    RECORD message
        num id;
        rawbytes data;
    ENDRECORD
    VAR message a;
    PERS message b;  ! -> RG309
    PROC main()
        ClearRawBytes a.data;
    ENDPROC
ENDMODULE
!=== record_signal
! rule: a component is no signal
! source: [K §2.14]
MODULE Demo
    RECORD r
        signaldi x;  ! -> RG327
    ENDRECORD
ENDMODULE
!=== records_by_name
! rule: records are compared by name, not by structure
! source: [K §2.17]
MODULE Demo
    RECORD r
        num x;
    ENDRECORD
    RECORD s
        num x;
    ENDRECORD
    VAR r a;
    VAR s b;
    PROC main()
        a := b;  ! -> RG307
        a := [b.x];
    ENDPROC
ENDMODULE
!=== semivalue_in_value_context
! rule: a signal is read as num
! source: [K §2.16, 2.17]
MODULE Demo
    VAR num a;
    VAR signaldi di1;
    PROC main()
        IF di1 = 1 a := di1 + 1;
    ENDPROC
ENDMODULE
!=== signal_assigned
! rule: a signal is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signaldo do1;
    PROC main()
        do1 := 1;  ! -> RG309
    ENDPROC
ENDMODULE
