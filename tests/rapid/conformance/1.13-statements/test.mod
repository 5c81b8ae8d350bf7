! rule: TEST with several values and DEFAULT, any expression as value
! source: [K §4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
        CASE 1, 2:
            a := 3;
        CASE a + 1:
            a := 4;
        DEFAULT:
            a := 5;
        ENDTEST
    ENDPROC
ENDMODULE
