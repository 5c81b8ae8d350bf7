! rule: a GOTO may not enter another branch
! source: [K §4.6]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 THEN
            GOTO other;  ! -> RG320
        ELSE
            other:
            a := 1;
        ENDIF
    ENDPROC
ENDMODULE
