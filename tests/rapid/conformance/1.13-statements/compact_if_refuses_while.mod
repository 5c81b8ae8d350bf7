! rule: a compact IF takes no compound statement
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 WHILE TRUE DO  ! -> RG201
        ENDWHILE
    ENDPROC
ENDMODULE
