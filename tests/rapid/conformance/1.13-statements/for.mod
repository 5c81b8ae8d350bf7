! rule: FOR with and without STEP
! source: [K §4.15]
MODULE Demo
    VAR num a;
    PROC main()
        FOR i FROM 1 TO 3 DO
            a := i;
        ENDFOR
        FOR i FROM 3 TO 1 STEP -1 DO
            a := i;
        ENDFOR
    ENDPROC
ENDMODULE
