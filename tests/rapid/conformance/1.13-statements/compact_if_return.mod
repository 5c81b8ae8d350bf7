! rule: a compact IF takes a simple statement: return
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 RETURN;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
