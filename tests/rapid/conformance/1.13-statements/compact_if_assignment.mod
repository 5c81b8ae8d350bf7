! rule: a compact IF takes a simple statement: assignment
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 a := 2;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
