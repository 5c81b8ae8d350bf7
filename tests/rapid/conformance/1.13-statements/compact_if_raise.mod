! rule: a compact IF takes a simple statement: raise
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 RAISE 5;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
