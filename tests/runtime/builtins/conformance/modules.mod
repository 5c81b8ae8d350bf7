MODULE modules
    ! source: [manual] S4 Load, UnLoad, StartLoad, WaitLoad; CheckProgRef, late binding [K §4.5]
    ! expect: FALSE
    ! expect: part 1
    ! expect: ERR_LOADED
    ! expect: TRUE
    ! expect: ERR_REFUNKPRC
    ! expect: ERR_UNLOAD
    ! expect: ERR_FILNOTFND
    ! expect: part 2
    ! expect: ERR_SYNTAX
    ! expect: ERR_LINKREF
    PROC main()
        VAR loadsession session;
        part "1", "TPWrite ""part 1"";";
        TPWrite ValToStr(ModExist("part1"));
        Load \Dynamic, "HOME:/part1.mod";
        %"part1_run"%;
        Load \Dynamic, "HOME:/part1.mod";
        TPWrite ValToStr(ModExist("part1"));
        UnLoad "HOME:/part1.mod";
        %"part1_run"%;
        UnLoad "HOME:/part1.mod";
        StartLoad \Dynamic, "HOME:/none.mod", session;
        WaitLoad session;
        part "2", "TPWrite ""part 2"";";
        StartLoad \Dynamic, "HOME:" \File:="part2.mod", session;
        WaitLoad session;
        %"part2_run"%;
        part "3", "TPWrite ""part 3"" THEN;";
        Load \Dynamic, "HOME:/part3.mod";
        part "4", "nobody_has_this;";
        Load \Dynamic, "HOME:/part4.mod" \CheckRef;
    ERROR
        TEST ERRNO
        CASE ERR_LOADED:
            TPWrite "ERR_LOADED";
        CASE ERR_REFUNKPRC:
            TPWrite "ERR_REFUNKPRC";
        CASE ERR_UNLOAD:
            TPWrite "ERR_UNLOAD";
        CASE ERR_FILNOTFND:
            TPWrite "ERR_FILNOTFND";
        CASE ERR_SYNTAX:
            TPWrite "ERR_SYNTAX";
        CASE ERR_LINKREF:
            TPWrite "ERR_LINKREF";
        ENDTEST
        TRYNEXT;
    ENDPROC

    PROC part(string number, string statement)
        VAR iodev file;
        Open "HOME:" \File:="part" + number + ".mod", file \Write;
        Write file, "MODULE part" + number;
        Write file, "PROC part" + number + "_run()";
        Write file, statement;
        Write file, "ENDPROC";
        Write file, "ENDMODULE";
        Close file;
    ENDPROC
ENDMODULE
