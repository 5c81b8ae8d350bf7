MODULE symbols
    ! source: 3HAC16581-1 GetDataVal, SetDataVal, SetDataSearch, GetNextSym [manual]; error pairing [mem]
    ! robot: irb120
    ! expect: 7
    ! expect: 9
    ! expect: 4
    ! expect: 5
    ! expect: my_a my_b
    ! expect: ERR_SYM_ACCESS
    ! expect: ERR_SYM_ACCESS
    ! expect: ERR_SYMBOL_TYPE
    ! expect: hidden 3
    ! expect: 11 11 3 1
    ! expect: tool0
    ! expect: gripper 5
    ! expect: gripper
    VAR num my_a := 7;
    PERS num my_b := 8;
    CONST num my_c := 1;
    LOCAL VAR num hidden := 3;
    VAR num list{3} := [4,5,6];
    PERS tooldata gripper := [TRUE,[[0,0,5],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];

    PERS tooldata tool := [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];

    PROC main()
        VAR num n;
        VAR string s;
        VAR string name;
        VAR string names := "";
        VAR datapos block;
        VAR num same := 11;
        GetDataVal "my_a", n;
        TPWrite ValToStr(n);
        SetDataVal "my_b", 9;
        TPWrite ValToStr(my_b);
        GetDataVal "list{1}", n;
        TPWrite ValToStr(n);
        SetDataVal "list{3}", 5;
        TPWrite ValToStr(list{3});
        SetDataSearch "num" \Object:="my_.*" \PersSym \VarSym;
        WHILE GetNextSym(name, block \Recursive) DO
            IF names <> "" names := names + " ";
            names := names + name;
        ENDWHILE
        TPWrite names;
        GetDataVal "nothing", n;
        SetDataVal "my_c", 2;
        GetDataVal "my_a", s;
        SetDataSearch "num" \Object:="hidden" \LocalSym;
        IF GetNextSym(name, block \Recursive) THEN
            GetDataVal name \Block:=block, n;
            TPWrite name + " " + ValToStr(n);
        ENDIF
        SetAllDataVal "num" \Object:="my_.*", same;
        TPWrite ValToStr(my_a) + " " + ValToStr(my_b) + " " + ValToStr(hidden) + " " + ValToStr(my_c);
        GetSysData tool \ObjectName:=name;
        TPWrite name;
        SetSysData gripper;
        GetSysData tool \ObjectName:=name;
        TPWrite name + " " + ValToStr(tool.tframe.trans.z);
        SetSysData tool \ObjectName:="gripper";
        GetSysData tool \ObjectName:=name;
        TPWrite name;
    ERROR
        IF ERRNO = ERR_SYM_ACCESS TPWrite "ERR_SYM_ACCESS";
        IF ERRNO = ERR_SYMBOL_TYPE TPWrite "ERR_SYMBOL_TYPE";
        TRYNEXT;
    ENDPROC
ENDMODULE
