! rule: CONNECT takes a variable
! source: [K §4.12]
MODULE Demo
    CONST intnum i := 1;
    PROC main()
        CONNECT i WITH t;  ! -> RG326
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
