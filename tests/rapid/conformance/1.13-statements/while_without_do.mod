! rule: WHILE has DO
! source: [K §4.16]
MODULE Demo
    VAR num a;
    PROC main()
        WHILE a < 3
            a := a + 1;  ! -> RG201
        ENDWHILE
    ENDPROC
ENDMODULE
