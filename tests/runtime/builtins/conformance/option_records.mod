MODULE option_records
    ! source: abb-rapidserver [code] declares a sensor as an aggregate of three; components [manual]
    ! expect: 2 [0,0,2]
    PERS sensor host := [0,0,2];
    PROC main()
        TPWrite ValToStr(host.state) + " " + ValToStr(host);
    ENDPROC
ENDMODULE
