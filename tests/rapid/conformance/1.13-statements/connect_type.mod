! rule: CONNECT takes a num
! source: [K §4.12]
MODULE Demo
    VAR string i;
    PROC main()
        CONNECT i WITH t;  ! -> RG307
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
