! rule: ELSE is the last branch
! source: [K §4.13]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 THEN
        ELSE
        ELSE  ! -> RG201
        ENDIF
    ENDPROC
ENDMODULE
