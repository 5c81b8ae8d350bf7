! rule: a compact IF takes a simple statement: exit
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 EXIT;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
