! rule: a compact IF takes no compound statement
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 FOR i FROM 1 TO 2 DO  ! -> RG201
        ENDFOR
    ENDPROC
ENDMODULE
