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
