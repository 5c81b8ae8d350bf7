MODULE search_predefined
    ! source: Keyence's CV-X modules [code] find tool0 and wobj0 by a search
    ! expect: tool_b tool0
    ! expect: wobj0
    ! expect: tool_b
    ! expect: tool_b
    ! expect: nothing
    ! expect: 0.001
    PERS tooldata tool_b := [TRUE,[[0,0,5],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    VAR datapos block;
    VAR string name;

    PROC main()
        VAR tooldata found;
        SetDataSearch "tooldata" \Object:="tool.*";
        told;
        SetDataSearch "wobjdata" \Object:="wobj0";
        told;
        SetDataSearch "tooldata" \InTask;
        told;
        SetDataSearch "tooldata" \InMod:="search_predefined";
        told;
        SetDataSearch "tooldata" \Object:="tool0" \VarSym;
        told;
        SetDataSearch "tooldata" \Object:="tool0";
        IF GetNextSym(name, block \Recursive) THEN
            GetDataVal name \Block:=block, found;
            TPWrite ValToStr(found.tload.mass);
        ENDIF
    ENDPROC

    PROC told()
        VAR string names := "";
        WHILE GetNextSym(name, block \Recursive) DO
            IF names <> "" names := names + " ";
            names := names + name;
        ENDWHILE
        IF names = "" names := "nothing";
        TPWrite names;
    ENDPROC
ENDMODULE
