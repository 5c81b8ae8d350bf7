! rule: arguments of EGMSetupGI
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR mecunit v_mecunit;
    VAR signalgi v_signalgi;
    VAR string v_string;
    PROC main()
        EGMSetupGI v_mecunit, v_egmident, v_string;
        EGMSetupGI v_mecunit, v_egmident, v_string \Joint \APTR \giR1x:=v_signalgi \giR2y:=v_signalgi \giR3z:=v_signalgi \giR4rx:=v_signalgi \giR5ry:=v_signalgi \giR6rz:=v_signalgi \giE1:=v_signalgi \giE2:=v_signalgi \giE3:=v_signalgi \giE4:=v_signalgi \giE5:=v_signalgi \giE6:=v_signalgi;
        EGMSetupGI;  ! -> RG311?
    ENDPROC
ENDMODULE
