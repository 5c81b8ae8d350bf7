! rule: a GOTO may leave a block
! source: [K §4.6]
MODULE Demo
    PROC main()
        FOR i FROM 1 TO 3 DO
            IF i = 2 GOTO out;
        ENDFOR
        out:
    ENDPROC
ENDMODULE
