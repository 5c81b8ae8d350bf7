! rule: a name of 33 characters is too long
! source: [K §2.3]
MODULE Demo
    VAR num nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn;  ! -> RG220
    PROC main()
        nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn := 1;
    ENDPROC
ENDMODULE
