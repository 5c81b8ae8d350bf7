MODULE clocks
    ! source: [manual] S4 ClkStart to ClkReset; CDate, CTime
    ! expect: 1.5
    ! expect: 1.5
    ! expect: 0
    ! expect: 10 8
    VAR clock watch;

    PROC main()
        ClkStart watch;
        WaitTime 1.5;
        ClkStop watch;
        TPWrite ValToStr(Round(ClkRead(watch) \Dec:=2));
        WaitTime 1;
        TPWrite ValToStr(Round(ClkRead(watch) \Dec:=2));
        ClkReset watch;
        TPWrite ValToStr(ClkRead(watch));
        TPWrite ValToStr(StrLen(CDate())) + " " + ValToStr(StrLen(CTime()));
    ENDPROC
ENDMODULE
