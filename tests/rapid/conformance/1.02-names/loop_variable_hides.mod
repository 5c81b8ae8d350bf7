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
