! rule: arguments of ResetPPMoved
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ResetPPMoved;
        ResetPPMoved 1;  ! -> RG311
    ENDPROC
ENDMODULE
