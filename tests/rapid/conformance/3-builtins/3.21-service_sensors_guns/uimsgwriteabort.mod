! rule: arguments of UIMsgWriteAbort
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        UIMsgWriteAbort;
        UIMsgWriteAbort 1;  ! -> RG311
    ENDPROC
ENDMODULE
