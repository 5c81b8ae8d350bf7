! rule: a routine variable is accepted with a warning
! source: [K §4.12, 8.2]
MODULE Demo
    PROC main()
        VAR intnum i;
        CONNECT i WITH t;  ! -> RG326?
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
