! rule: whole arrays of equal shape are assigned and compared
! source: [K §2.17, 3.11]
MODULE Demo
    VAR num a{3};
    VAR num b{3};
    PROC main()
        a := b;
        IF a = b AND a <> b a := b;
    ENDPROC
ENDMODULE
