! rule: arguments of STTuneReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        STTuneReset v_mecunit;
        STTuneReset;  ! -> RG311?
    ENDPROC
ENDMODULE
