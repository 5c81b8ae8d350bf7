! rule: a compact IF takes a simple statement: connect
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 CONNECT i WITH t;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
