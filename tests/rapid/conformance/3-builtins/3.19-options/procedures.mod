! rule: procedures of options are not unknown
! source: [manual] 3HAC050917
! given: system
MODULE Demo
    PROC main()
        ActEventBuffer;
        STClose "gun1", 1000, 5;
        NoSuchOption;  ! -> RG301
    ENDPROC
ENDMODULE
