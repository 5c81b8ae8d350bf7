MODULE delimiters
    ! source: [mem] RobotWare 6 manual, ReadStr: the delimiters, and the line feed by default
    ! case:
    ! expect: a|b|c|d|
    ! case: delimiters=alone
    ! expect: a|b_c|d_|EOF|
    PROC main()
        VAR iodev file;
        VAR string all;
        Open "HOME:" \File:="list.txt", file \Write;
        Write file, "a;b";
        Write file, "c;d";
        Close file;
        Open "HOME:" \File:="list.txt", file \Read;
        FOR i FROM 1 TO 4 DO
            all := all + ReadStr(file \Delim:=";") + "|";
        ENDFOR
        TPWrite StrMap(all, "\0A", "_");
    ENDPROC
ENDMODULE
