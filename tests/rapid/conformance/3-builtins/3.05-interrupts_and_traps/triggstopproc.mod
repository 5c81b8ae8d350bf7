! rule: arguments of TriggStopProc
! source: [manual] 3HAC050917
MODULE Demo
    PERS restartdata r;
    VAR signaldo s;
    VAR signalgo g;
    PROC main()
        TriggStopProc r, s;
        TriggStopProc r \DO1:=s \GO1:=g \GO2:=g \GO3:=g \GO4:=g, s;
        TriggStopProc r;  ! -> RG311
    ENDPROC
ENDMODULE
