! rule: a GOTO may not enter a block
! source: [K §4.6]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 GOTO inside;  ! -> RG320
        FOR i FROM 1 TO 3 DO
            inside:
            a := i;
        ENDFOR
    ENDPROC
ENDMODULE
