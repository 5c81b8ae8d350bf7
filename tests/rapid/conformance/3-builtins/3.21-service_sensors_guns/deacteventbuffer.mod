! rule: arguments of DeactEventBuffer
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        DeactEventBuffer;
        DeactEventBuffer 1;  ! -> RG311?
    ENDPROC
ENDMODULE
