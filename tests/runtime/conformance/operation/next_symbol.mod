MODULE next_symbol
    ! source: [code] programs that seek camera devices or units, and their own data; a switch
    ! robot: irb120
    ! case: next_symbol=level
    ! do: start, run 1
    ! expect: tool0
    ! expect: my_tool
    ! case: next_symbol=below
    ! do: start, run 1
    ! expect: my_tool tool0
    ! expect: my_tool
    PERS tooldata my_tool := [TRUE,[[0,0,5],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    VAR datapos block;
    VAR string name;

    PROC main()
        SetDataSearch "tooldata";
        told;
        SetDataSearch "tooldata" \InMod:="next_symbol";
        told;
    ENDPROC

    PROC told()
        VAR string names := "";
        WHILE GetNextSym(name, block) DO
            IF names <> "" names := names + " ";
            names := names + name;
        ENDWHILE
        IF names = "" names := "nothing";
        TPWrite names;
    ENDPROC
ENDMODULE
