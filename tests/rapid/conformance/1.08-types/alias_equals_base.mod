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
