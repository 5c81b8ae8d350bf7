! rule: statements behind RETURN are not reached
! source: [K §4.7]
MODULE Demo
    PROC main()
        RETURN;
        TPErase;  ! -> RG323?
    ENDPROC
ENDMODULE
