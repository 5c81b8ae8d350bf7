! rule: WHILE
! source: [K §4.16]
MODULE Demo
    VAR num a;
    PROC main()
        WHILE a < 3 DO
            a := a + 1;
        ENDWHILE
    ENDPROC
ENDMODULE
