MODULE arc_welding
    ! source: [manual] 3HAC050988 phases of seamdata, speed by welddata; PROC.cfg [code] for the signals
    ! robot: irb120
    ! signal: doGas DO
    ! signal: doWeld DO
    ! signal: doFeed DO
    ! signal: diArc DI
    ! signal: siInhibit DI
    ! signal: aoVolt AO
    ! signal: goJob GO 8
    ! signal: doPlace DO
    ! arc: GasOn doGas
    ! arc: WeldOn doWeld
    ! arc: FeedOn doFeed
    ! arc: ArcEst diArc
    ! arc: WeldInhib siInhibit
    ! arc: VoltReference aoVolt
    ! arc: SchedulePort goJob
    ! do: start, run 20, signal siInhibit 1, run 5
    ! 0.5 s of gas on a way that takes longer, and 0.3 s more at the start, before the arc
    ! expect: gas
    ! expect: at the start after 0.8 s of gas
    ! expect: arc 22 3
    ! 60 mm at 20 mm/s, whatever Speed says
    ! expect: seam in 3 s
    ! expect: place
    ! filling for 0.4 s with its data, then gas for 0.2 s
    ! expect: crater 15 4
    ! expect: end after 1.7 s, gas 0, arc 0
    ! expect: does not fit
    ! a start in a corner burns from its middle on, an end there to its middle
    ! expect: arc 22 3
    ! expect: flying 1 1
    ! expect: out 0 0
    ! without a start the robot stands for the gas, and begins
    ! expect: gas
    ! expect: arc 22 3
    ! inhibited: Speed holds, nothing burns
    ! expect: 60 mm at 200 mm/s, arc 0
    ! expect: arc off
    ! log: 49905 weaving is not simulated: the tool goes along the seam at its speed
    ! a program that stands has no arc, nor one that was given up
    ! do: pp-to-main, signal siInhibit 0, routine long, start, run 1
    ! value: doWeld = 1
    ! do: stop, run 1
    ! value: doWeld = 0
    ! do: start, run 1
    ! value: doWeld = 1
    ! value: doGas = 1
    ! do: stop, run 1, pp-to-main, start, run 0.1
    ! value: doWeld = 0
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    TASK PERS seamdata seam := [0.5,0.3,[0,0,0,0,0,0,0,0,0],0,0,0,0,0,[0,0,0,0,0,0,0,0,0],0,
        0.4,[4,0,15,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0.2];
    TASK PERS seamdata quick := [0,0,[0,0,0,0,0,0,0,0,0],0,0,0,0,0,[0,0,0,0,0,0,0,0,0],0,
        0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0];
    TASK PERS welddata bead := [20,0,[3,0,22,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];
    TASK PERS welddata wrong := [20,0,[300,0,22,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];
    TASK PERS weavedata zigzag := [1,0,3,4,0,0,0,0,0,0,0,0,0,0,0];
    TASK PERS trackdata none := [0,FALSE,50,[0,0,0,0,0,0,0,0,0],[0,0,0,0,0,0,0]];
    VAR clock gas_since;
    VAR clock since;
    VAR intnum i;
    VAR intnum j;
    VAR intnum k;
    VAR intnum l;
    VAR triggdata place;
    TRAP gas
        TPWrite "gas";
        ClkReset gas_since;
        ClkStart gas_since;
    ENDTRAP
    TRAP arc
        TPWrite "arc " + ValToStr(aoVolt) + " " + ValToStr(goJob);
    ENDTRAP
    TRAP crater
        TPWrite "crater " + ValToStr(aoVolt) + " " + ValToStr(goJob);
    ENDTRAP
    TRAP placed
        TPWrite "place";
    ENDTRAP
    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        CONNECT i WITH gas;
        ISignalDO doGas, 1, i;
        CONNECT j WITH arc;
        ISignalDO doWeld, 1, j;
        ArcMoveL Offs(p,0,-100,0), v200, fine, tool0;
        ArcLStart p, v100, seam, bead \Weave:=zigzag, fine, tool0 \WObj:=wobj0 \SeamName:="first";
        TPWrite "at the start after " + ValToStr(Round(ClkRead(gas_since) \Dec:=1)) + " s of gas";
        CONNECT k WITH crater;
        ISignalGO goJob, k;
        CONNECT l WITH placed;
        TriggInt place, 10, l;
        begin;
        ArcL Offs(p,0,60,0), v1000, seam, bead \Weave:=zigzag, fine, tool0 \Track:=none;
        TPWrite "seam in " + ValToStr(Round(ClkRead(since))) + " s";
        begin;
        ArcLEnd Offs(p,0,60,20), v1000, seam, bead, fine, tool0 \T1:=place;
        TPWrite "end after " + ValToStr(Round(ClkRead(since) \Dec:=1)) + " s, gas " + ValToStr(doGas)
            + ", arc " + ValToStr(diArc);
        IDelete k;
        IDelete i;
        ArcL p, v1000, seam, wrong, fine, tool0;
        ArcLStart Offs(p,0,30,20), v200, quick, bead, z10, tool0;
        ArcC Offs(p,0,20,10), Offs(p,0,10,20), v200, quick, bead, z1, tool0;
        WaitUntil doWeld = 1 \PollRate:=0.01;
        TPWrite "flying " + ValToStr(doGas) + " " + ValToStr(doWeld);
        ArcLEnd Offs(p,0,-10,20), v200, quick, bead, z10, tool0;
        MoveL Offs(p,0,-10,60), v200, fine, tool0;
        TPWrite "out " + ValToStr(doGas) + " " + ValToStr(doWeld);
        CONNECT i WITH gas;
        ISignalDO doGas, 1, i;
        ArcL Offs(p,0,0,60), v200, quick, bead, fine, tool0;
        ArcLEnd p, v200, quick, bead, fine, tool0;
        SetDO doPlace, 1;
        WaitDI siInhibit, 1;
        begin;
        ArcL Offs(p,0,60,0), v200, quick, bead, fine, tool0;
        IF ClkRead(since) < 0.5 TPWrite "60 mm at 200 mm/s, arc " + ValToStr(doWeld);
        ArcLEnd p, v200, quick, bead, fine, tool0;
        TPWrite "arc off";
    ERROR
        IF ERRNO = ERR_GO_LIM TPWrite "does not fit";
        TRYNEXT;
    ENDPROC
    PROC long()
        MoveAbsJ start, v1000, fine, tool0;
        ArcLStart p, v100, quick, bead, fine, tool0;
        ArcLEnd Offs(p,0,60,0), v1000, quick, bead, fine, tool0;
    ENDPROC
    PROC begin()
        ClkReset since;
        ClkStart since;
    ENDPROC
ENDMODULE
