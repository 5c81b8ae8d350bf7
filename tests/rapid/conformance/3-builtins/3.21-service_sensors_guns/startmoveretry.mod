! rule: arguments of StartMoveRetry
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StartMoveRetry;
        StartMoveRetry 1;  ! -> RG311
    ENDPROC
ENDMODULE
