! rule: ERRNO and INTNO are read-only
! source: [K §7.1, 8.3]
MODULE Demo
    PROC main()
        ERRNO := 1;  ! -> RG310
        INTNO := 1;  ! -> RG310
    ENDPROC
ENDMODULE
