! rule: FCCalib and FCPress1LStart of the templates of Machining FC
! source: [code] HOME:/MachiningFC in the backup of an IRB 120 (rparak/VInRoS_ABB_RS)
MODULE Demo
    PERS tooldata t;
    PERS wobjdata w;
    PERS loaddata l;
    VAR robtarget p;
    PROC main()
        FCCalib l \Recovery;
        FCPress1LStart p, v50 \Fx:=0 \Fy:=0 \Fz:=10, 50 \ForceFrameRef:=1 \ForceChange:=50 \DampingTune:=100 \TimeOut:=5, \UseSpdFFW, \PosSupvDist:=9E9, fine, t \WObj:=w;
        FCCalib l \Recover;  ! -> RG312
    ENDPROC
ENDMODULE
