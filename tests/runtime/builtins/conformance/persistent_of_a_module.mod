MODULE persistent_of_a_module
    ! source: [K §14.4] a system-global PERS is there while a module that declares it is loaded; only
    ! then does an initial value count. [VC 6.15] A module that is loaded again has its declared values
    ! task: T_TWO second
    ! expect: 5 7
    ! expect: 8 9
    ! expect: 5 9
    ! expect: 9
    PERS num common := 7;
    PERS num loaded := 0;
    PROC main()
        VAR iodev file;
        Open "HOME:" \File:="part.mod", file \Write;
        Write file, "MODULE part";
        Write file, "PERS num alone := 5;";
        Write file, "PERS num common := 1;";
        Write file, "PROC show()";
        Write file, "TPWrite ValToStr(alone) + "" "" + ValToStr(common);";
        Write file, "alone := 8; common := 9;";
        Write file, "ENDPROC";
        Write file, "ENDMODULE";
        Close file;
        Load "HOME:/part.mod";
        %"show"%;
        %"show"%;
        UnLoad "HOME:/part.mod";
        Load "HOME:/part.mod";
        %"show"%;
        loaded := 1;
    ENDPROC
    PROC second()
        WaitUntil loaded = 1;
        TPWrite ValToStr(common);
    ENDPROC
ENDMODULE
