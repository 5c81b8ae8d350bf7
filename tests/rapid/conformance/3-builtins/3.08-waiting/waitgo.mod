! rule: arguments of WaitGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo s;
    VAR signaldo dout;
    VAR num n;
    VAR dnum d;
    PROC main()
        WaitGO s, 1;
        WaitGO s \NOTEQ, 1 \MaxTime:=1 \ValueAtTimeout:=n \Visualize \Header:="h" \Message:="m" \Wrap \Icon:=iconInfo \Image:="i" \VisualizeTime:=1 \UIActiveSignal:=dout;
        WaitGO s \LT, d \MaxTime:=1 \DvalueAtTimeout:=d;
        WaitGO s \GT, 1;
        WaitGO s;  ! -> RG311
        WaitGO s \LT \GT, 1;  ! -> RG313
    ENDPROC
ENDMODULE
