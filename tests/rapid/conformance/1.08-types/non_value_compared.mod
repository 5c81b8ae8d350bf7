! rule: a non-value is not compared
! source: [K §2.16]
MODULE Demo
    VAR rawbytes c;
    VAR rawbytes d;
    PROC main()
        IF c = d THEN  ! -> RG309 RG309
        ENDIF
    ENDPROC
ENDMODULE
