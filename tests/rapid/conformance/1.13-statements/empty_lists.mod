! rule: statement lists may be empty
! source: [K §4.2]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 THEN
        ELSE
        ENDIF
        FOR i FROM 1 TO 2 DO
        ENDFOR
        TEST a
        ENDTEST
    ENDPROC
ENDMODULE
