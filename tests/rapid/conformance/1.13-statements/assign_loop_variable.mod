! rule: a loop variable is read-only
! source: [K §4.15]
MODULE Demo
    PROC main()
        FOR i FROM 1 TO 3 DO
            i := 5;  ! -> RG310
        ENDFOR
    ENDPROC
ENDMODULE
