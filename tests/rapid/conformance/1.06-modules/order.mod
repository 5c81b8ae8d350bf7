! rule: types, then data, then routines
! source: [K §5, 9.1]
MODULE Demo
    RECORD r
        num x;
    ENDRECORD
    ALIAS num n;
    CONST num c := 1;
    VAR r a;
    PERS n p := 1;
    PROC main()
    ENDPROC
ENDMODULE
