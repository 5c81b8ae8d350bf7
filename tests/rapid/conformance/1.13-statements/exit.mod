! rule: EXIT ends the task
! source: [K §4.9]
MODULE Demo
    PROC main()
        EXIT;
        TPErase;  ! -> RG323?
    ENDPROC
ENDMODULE
