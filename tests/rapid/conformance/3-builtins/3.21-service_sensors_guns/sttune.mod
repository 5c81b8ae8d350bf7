! rule: arguments of STTune
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR tunegtype v_tunegtype;
    PROC main()
        STTune v_mecunit, v_num, v_tunegtype;
        STTune;  ! -> RG311?
    ENDPROC
ENDMODULE
