! rule: there is no statement that leaves a loop: Break is a procedure
! source: [K §4, 11]
MODULE Demo
    PROC main()
        WHILE TRUE DO
            Break;
        ENDWHILE
    ENDPROC
ENDMODULE
