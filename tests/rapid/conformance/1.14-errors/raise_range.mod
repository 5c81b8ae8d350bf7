! rule: own error numbers are 1 to 90
! source: [K §4.8, 7.1]
MODULE Demo
    VAR bool a;
    PROC main()
        IF a RAISE 90;
        RAISE 91;  ! -> RG321
    ENDPROC
ENDMODULE
