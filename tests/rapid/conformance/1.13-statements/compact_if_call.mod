! rule: a compact IF takes a simple statement: call
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR intnum i;
    PROC main()
        IF a = 1 TPErase;
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
