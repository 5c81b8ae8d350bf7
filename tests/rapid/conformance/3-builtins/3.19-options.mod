!=== force_end
! rule: arguments of FCPressEnd
! source: [code] two programs that polish: a server, and a generator of paths
MODULE Demo
    PERS tooldata t;
    PERS wobjdata w;
    VAR robtarget p;
    PROC main()
        FCPressEnd p, v50, t;
        FCPressEnd p, v50 \ForceChange:=100, \ZeroContactValue:=5, t \WObj:=w;
        FCPressEnd p, v50 \ZeroContactValue:=5, t;
        FCPressEnd p, v50 \DeactOnly, t;
        FCPressEnd p, v50 \ZeroContact:=5, t;  ! -> RG312
    ENDPROC
ENDMODULE
!=== force_templates
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
!=== functions
! rule: functions of options are not unknown
! source: [manual] 3HAC050917
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := ProgMemFree();
        n := NoSuchOption();  ! -> RG301
    ENDPROC
ENDMODULE
!=== hidden_elsewhere
! rule: a module that is not here may hide a built-in that not every controller has
! source: [K §2.12] [code] TechnoX/ABB-YUMI-LIB calls its own GetJointData from another module
MODULE Demo
    VAR num n;
    PROC main()
        GetJointData 1, 2, n, n;  ! -> RG311?
        Incr n, 2;  ! -> RG311
        Reset;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== hidden_nowhere
! rule: nothing hides a built-in where everything is here
! source: [K §2.12]
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        GetJointData 1, 2, n, n;  ! -> RG311
        Incr n, 2;  ! -> RG311
        Reset;  ! -> RG311
    ENDPROC
ENDMODULE
!=== own_names_come_first
! rule: what a program declares hides the name of an option
! source: [K §2.12, 2.20]
! given: system
MODULE Demo
    VAR num n;
    VAR num toolno;
    PROC main()
        toolno := 1;
        n := toolno;
        Calibrate 1;
        Calibrate;  ! -> RG311
    ENDPROC
    PROC Calibrate(num a)
        TPWrite "a" \Num:=a;
    ENDPROC
ENDMODULE
!=== procedures
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
!=== types
! rule: types of options are not unknown
! source: [manual] 3HAC050917
! given: system
MODULE Demo
    VAR num n;
    VAR sensorvardata d;
    VAR no_such_data e;  ! -> RG303
    PROC main()
        d.x := 1;
        n := d.x;
    ENDPROC
ENDMODULE
!=== values
! rule: named values of options are not unknown
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := AW_WELD_ERR;
        n := NO_SUCH_ERR;  ! -> RG302
    ENDPROC
ENDMODULE
