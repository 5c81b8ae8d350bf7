! rule: arguments of WaitGI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi s;
    VAR signaldo dout;
    VAR num n;
    VAR dnum d;
    PROC main()
        WaitGI s, 1;
        WaitGI s \NOTEQ, 1 \MaxTime:=1 \ValueAtTimeout:=n \Visualize \Header:="h" \Message:="m" \Wrap \Icon:=iconInfo \Image:="i" \VisualizeTime:=1 \UIActiveSignal:=dout;
        WaitGI s \LT, d \MaxTime:=1 \DvalueAtTimeout:=d;
        WaitGI s \GT, 1;
        WaitGI s;  ! -> RG311
        WaitGI s \LT \GT, 1;  ! -> RG313
    ENDPROC
ENDMODULE
