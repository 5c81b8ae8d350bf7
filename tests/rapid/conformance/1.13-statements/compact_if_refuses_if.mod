! rule: a compact IF takes no compound statement
! source: [K §4.14]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        IF a = 1 IF b = 1 a := 2;  ! -> RG201
    ENDPROC
ENDMODULE
