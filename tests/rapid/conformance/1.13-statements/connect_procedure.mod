! rule: CONNECT takes a trap
! source: [K §4.12]
MODULE Demo
    VAR intnum i;
    PROC main()
        CONNECT i WITH main;  ! -> RG306
    ENDPROC
ENDMODULE
