MODULE saving
    ! source: [K §2.18, 2.23] a saved module holds the present value of its persistents; S4 Save
    ! expect: PERS pos where:=[1.5,2,0.1]; ! kept
    ! expect: ERR_PATH
    ! expect: ERR_MODULE
    PERS pos where:=[0,0,0]; ! kept
    PERS num other;

    PROC main()
        VAR iodev file;
        VAR string line;
        where := [1.5,2,0.1];
        Save "saving" \FilePath:="HOME:/copy.mod";
        Open "HOME:/copy.mod", file \Read;
        WHILE line <> EOF DO
            line := ReadStr(file);
            IF StrLen(line) > 14 THEN
                IF StrPart(line, 1, 14) = "    PERS pos w" TPWrite StrPart(line, 5, StrLen(line) - 4);
            ENDIF
        ENDWHILE
        Close file;
        Save "saving";
        Save "nothing" \FilePath:="HOME:/copy.mod";
    ERROR
        IF ERRNO = ERR_PATH TPWrite "ERR_PATH";
        IF ERRNO = ERR_MODULE TPWrite "ERR_MODULE";
        TRYNEXT;
    ENDPROC
ENDMODULE
