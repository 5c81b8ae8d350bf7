! rule: arguments of ActEventBuffer
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ActEventBuffer;
        ActEventBuffer 1;  ! -> RG311?
    ENDPROC
ENDMODULE
