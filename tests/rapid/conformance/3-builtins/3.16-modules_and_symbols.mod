!=== cancelload
! rule: arguments of CancelLoad
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession v_loadsession;
    PROC main()
        CancelLoad v_loadsession;
        CancelLoad;  ! -> RG311?
        CancelLoad v_loadsession \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== checkprogref
! rule: arguments of CheckProgRef
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        CheckProgRef;
        CheckProgRef 1;  ! -> RG311
        CheckProgRef \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== erasemodule
! rule: arguments of EraseModule
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        EraseModule "x";
        EraseModule;  ! -> RG311?
        EraseModule "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== getdataval
! rule: arguments of GetDataVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR datapos v_datapos;
    VAR taskid v_taskid;
    PROC main()
        GetDataVal "x", v_num;
        GetDataVal "x" \Block:=v_datapos, v_num;
        GetDataVal "x" \TaskRef:=v_taskid, v_num;
        GetDataVal "x" \TaskName:="x", v_num;
        GetDataVal "x";  ! -> RG311
        GetDataVal "x", v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== getnextsym
! rule: arguments of GetNextSym
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    VAR datapos v_datapos;
    VAR bool r_bool;
    PROC main()
        r_bool := GetNextSym(v_string, v_datapos);
        r_bool := GetNextSym(v_string, v_datapos \Recursive);
        r_bool := GetNextSym(v_string);  ! -> RG311
        r_bool := GetNextSym(v_string, v_datapos \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== load
! rule: arguments of Load
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        Load "x";
        Load \Dynamic, "x" \File:="x" \CheckRef;
        Load;  ! -> RG311?
        Load "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== modexist
! rule: arguments of ModExist
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := ModExist("x");
        r_bool := ModExist();  ! -> RG311
        r_bool := ModExist("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== modtime
! rule: arguments of ModTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR stringdig v_stringdig;
    PROC main()
        r_num := ModTime("x");
        r_num := ModTime("x" \StrDig:=v_stringdig);
        r_num := ModTime();  ! -> RG311
        r_num := ModTime("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== readcfgdata
! rule: arguments of ReadCfgData
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        ReadCfgData "x", "x", v_num;
        ReadCfgData "x", "x", v_num \ListNo:=v_num;
        ReadCfgData "x", "x";  ! -> RG311
        ReadCfgData "x", "x", v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== save
! rule: arguments of Save
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    PROC main()
        Save "x";
        Save \TaskRef:=v_taskid, "x" \FilePath:="x" \File:="x";
        Save \TaskName:="x", "x" \FilePath:="x" \File:="x";
        Save;  ! -> RG311?
        Save "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== savecfgdata
! rule: arguments of SaveCfgData
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SaveCfgData "x", "SYS";
        SaveCfgData "x" \File:="x", "SYS";
        SaveCfgData "x";  ! -> RG311
        SaveCfgData "x", "SYS" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setalldataval
! rule: arguments of SetAllDataVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        SetAllDataVal "x", v_num;
        SetAllDataVal "x" \TypeMod:="x" \Object:="x" \Hidden, v_num;
        SetAllDataVal "x";  ! -> RG311
        SetAllDataVal "x", v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setdatasearch
! rule: arguments of SetDataSearch
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SetDataSearch "x";
        SetDataSearch "x" \TypeMod:="x" \Object:="x" \PersSym \VarSym \ConstSym \InTask \InRout:="x" \GlobalSym;
        SetDataSearch "x" \TypeMod:="x" \Object:="x" \PersSym \VarSym \ConstSym \InMod:="x" \InRout:="x" \LocalSym;
        SetDataSearch;  ! -> RG311?
        SetDataSearch "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setdataval
! rule: arguments of SetDataVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR datapos v_datapos;
    VAR taskid v_taskid;
    PROC main()
        SetDataVal "x", 1;
        SetDataVal "x" \Block:=v_datapos, 1;
        SetDataVal "x" \TaskRef:=v_taskid, 1;
        SetDataVal "x" \TaskName:="x", 1;
        SetDataVal "x";  ! -> RG311
        SetDataVal "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setsysdata
! rule: arguments of SetSysData
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    PROC main()
        SetSysData p_num;
        SetSysData p_num \ObjectName:="x";
        SetSysData;  ! -> RG311?
        SetSysData p_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== startload
! rule: arguments of StartLoad
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession v_loadsession;
    PROC main()
        StartLoad "x", v_loadsession;
        StartLoad \Dynamic, "x" \File:="x", v_loadsession;
        StartLoad "x";  ! -> RG311
        StartLoad "x", v_loadsession \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== unload
! rule: arguments of UnLoad
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        UnLoad "x";
        UnLoad \ErrIfChanged, "x" \File:="x";
        UnLoad \Save, "x" \File:="x";
        UnLoad;  ! -> RG311?
        UnLoad "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitload
! rule: arguments of WaitLoad
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession v_loadsession;
    PROC main()
        WaitLoad v_loadsession;
        WaitLoad \UnloadPath:="x" \UnloadFile:="x", v_loadsession \CheckRef;
        WaitLoad;  ! -> RG311?
        WaitLoad v_loadsession \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== warmstart
! rule: arguments of WarmStart
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WarmStart;
        WarmStart 1;  ! -> RG311
        WarmStart \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== writecfgdata
! rule: arguments of WriteCfgData
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        WriteCfgData "x", "x", 1;
        WriteCfgData "x", "x", 1 \ListNo:=v_num;
        WriteCfgData "x", "x";  ! -> RG311
        WriteCfgData "x", "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
