! rule: a loop variable ends with its loop
! source: [K §4.15]
! given: system
MODULE Demo
    VAR num a;
    PROC main()
        FOR i FROM 1 TO 3 DO
            a := i;
        ENDFOR
        a := i;  ! -> RG302
    ENDPROC
ENDMODULE
