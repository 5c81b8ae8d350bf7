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
