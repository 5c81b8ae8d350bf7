! rule: a TEST takes any value type
! source: [K §4.17]
MODULE Demo
    VAR string s;
    VAR pos p;
    PROC main()
        TEST s
        CASE "a":
            TPErase;
        ENDTEST
        TEST p
        CASE [1, 2, 3]:
            TPErase;
        ENDTEST
    ENDPROC
ENDMODULE
