! rule: IF, ELSEIF, ELSE
! source: [K §4.13]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 THEN
            b := 1;
        ELSEIF a = 2 THEN
            b := 2;
        ELSE
            b := 3;
        ENDIF
    ENDPROC
ENDMODULE
