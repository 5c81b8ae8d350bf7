! rule: CONNECT takes a variable of the module and a trap
! source: [K §4.12]
MODULE Demo
    VAR intnum i;
    PROC main()
        CONNECT i WITH t;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
