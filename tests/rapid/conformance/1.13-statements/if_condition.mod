! rule: a condition is bool
! source: [K §4.13]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a THEN  ! -> RG307
        ENDIF
    ENDPROC
ENDMODULE
