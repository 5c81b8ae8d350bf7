MODULE search_pattern
    ! source: [ABB] programs for the cameras of hands write a prefix and .*; a switch
    ! robot: irb120
    ! case: search_pattern=whole
    ! do: start, run 1
    ! expect: part
    ! expect: part2 part
    ! expect: part
    ! case: search_pattern=part
    ! do: start, run 1
    ! expect: part2 part
    ! expect: part2 part
    ! expect: part
    PERS num part2 := 2;
    PERS num part := 1;
    VAR datapos block;
    VAR string name;

    PROC main()
        SetDataSearch "num" \Object:="part" \InMod:="search_pattern";
        told;
        SetDataSearch "num" \Object:="^part.*$" \InMod:="search_pattern";
        told;
        SetDataSearch "num" \Object:="^part$" \InMod:="search_pattern";
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
