!=== ainput
! rule: arguments of AInput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalai v_signalai;
    VAR num r_num;
    PROC main()
        r_num := AInput(v_signalai);
        r_num := AInput();  ! -> RG311
        r_num := AInput(v_signalai \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== aliasio
! rule: arguments of AliasIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        AliasIO v_num, v_num;
        AliasIO v_num;  ! -> RG311
        AliasIO v_num, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== aoutput
! rule: arguments of AOutput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    VAR num r_num;
    PROC main()
        r_num := AOutput(v_signalao);
        r_num := AOutput();  ! -> RG311
        r_num := AOutput(v_signalao \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== dinput
! rule: arguments of DInput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldi v_signaldi;
    VAR dionum r_dionum;
    PROC main()
        r_dionum := DInput(v_signaldi);
        r_dionum := DInput();  ! -> RG311
        r_dionum := DInput(v_signaldi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== doutput
! rule: arguments of DOutput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    VAR dionum r_dionum;
    PROC main()
        r_dionum := DOutput(v_signaldo);
        r_dionum := DOutput();  ! -> RG311
        r_dionum := DOutput(v_signaldo \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== ginput
! rule: arguments of GInput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi v_signalgi;
    VAR num r_num;
    PROC main()
        r_num := GInput(v_signalgi);
        r_num := GInput();  ! -> RG311
        r_num := GInput(v_signalgi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== ginputdnum
! rule: arguments of GInputDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi v_signalgi;
    VAR dnum r_dnum;
    PROC main()
        r_dnum := GInputDnum(v_signalgi);
        r_dnum := GInputDnum();  ! -> RG311
        r_dnum := GInputDnum(v_signalgi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== goutput
! rule: arguments of GOutput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    VAR num r_num;
    PROC main()
        r_num := GOutput(v_signalgo);
        r_num := GOutput();  ! -> RG311
        r_num := GOutput(v_signalgo \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== goutputdnum
! rule: arguments of GOutputDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    VAR dnum r_dnum;
    PROC main()
        r_dnum := GOutputDnum(v_signalgo);
        r_dnum := GOutputDnum();  ! -> RG311
        r_dnum := GOutputDnum(v_signalgo \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== invertdo
! rule: arguments of InvertDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        InvertDO v_signaldo;
        InvertDO;  ! -> RG311?
        InvertDO v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== iodisable
! rule: arguments of IODisable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IODisable "x", 1;
        IODisable "x";  ! -> RG311
        IODisable "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ioenable
! rule: arguments of IOEnable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IOEnable "x", 1;
        IOEnable "x";  ! -> RG311
        IOEnable "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pulsedo
! rule: arguments of PulseDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        PulseDO v_signaldo;
        PulseDO \High \PLength:=1, v_signaldo;
        PulseDO;  ! -> RG311?
        PulseDO v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== reset
! rule: arguments of Reset
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        Reset v_signaldo;
        Reset;  ! -> RG311?
        Reset v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== set
! rule: arguments of Set
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        Set v_signaldo;
        Set;  ! -> RG311?
        Set v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setao
! rule: arguments of SetAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    PROC main()
        SetAO v_signalao, 1;
        SetAO v_signalao;  ! -> RG311
        SetAO v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setdo
! rule: arguments of SetDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        SetDO v_signaldo, 1;
        SetDO \SDelay:=1, v_signaldo, 1;
        SetDO \Sync, v_signaldo, 1;
        SetDO v_signaldo;  ! -> RG311
        SetDO v_signaldo, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setgo
! rule: arguments of SetGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    PROC main()
        SetGO v_signalgo, 1;
        SetGO \SDelay:=1, v_signalgo, 1;
        SetGO v_signalgo;  ! -> RG311
        SetGO v_signalgo, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== testdi
! rule: arguments of TestDI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldi v_signaldi;
    VAR bool r_bool;
    PROC main()
        r_bool := TestDI(v_signaldi);
        r_bool := TestDI();  ! -> RG311
        r_bool := TestDI(v_signaldi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== validio
! rule: arguments of ValidIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := ValidIO(v_num);
        r_bool := ValidIO();  ! -> RG311
        r_bool := ValidIO(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
