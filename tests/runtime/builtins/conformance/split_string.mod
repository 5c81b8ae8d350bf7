MODULE split_string
    ! source: [manual] S4 StrFind, StrPart, StrLen: not found is length + 1; outside is an error; Machina [code]: right behind is not
    ! expect: alpha
    ! expect: 2
    ! expect: gamma
    ! expect: 4 4
    ! expect: outside
    ! expect: outside
    ! expect: outside
    PROC main()
        split "alpha,2,gamma";
        TPWrite ValToStr(StrFind("abc", 4, "x")) + " " + ValToStr(StrMatch("abc", 4, "xy"));
        TPWrite ValToStr(StrFind("abc", 5, "x"));
        TPWrite ValToStr(StrFind("abc", 0, "xy"));
        TPWrite ValToStr(StrMatch("abc", 5, "x"));
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "outside";
        TRYNEXT;
    ENDPROC

    PROC split(string line)
        VAR num start := 1;
        VAR num stop_at;
        WHILE start <= StrLen(line) DO
            stop_at := StrFind(line, start, ",");
            TPWrite StrPart(line, start, stop_at - start);
            start := stop_at + 1;
        ENDWHILE
    ENDPROC
ENDMODULE
