MODULE maths
    ! source: [manual] S4 Sin to ATan2 (degrees), Pow, Sqrt, Round, Trunc; half away from zero [mem]
    ! expect: 0.5 60 135
    ! expect: 1024 1.41421
    ! expect: 1 -1 0.38
    ! expect: 3
    ! expect: ERR_ARGVALERR
    ! expect: ERR_ARGVALERR
    ! expect: 1.4142135623731
    ! expect: not whole
    PERS num counter := 1;

    PROC main()
        TPWrite ValToStr(Sin(30)) + " " + ValToStr(ACos(0.5)) + " " + ValToStr(ATan2(1, -1));
        TPWrite ValToStr(Pow(2, 10)) + " " + ValToStr(Sqrt(2));
        TPWrite ValToStr(Round(0.5)) + " " + ValToStr(Trunc(-1.9)) + " " + ValToStr(Round(0.375 \Dec:=2));
        Incr counter;
        Add counter, 2;
        Decr counter;
        TPWrite ValToStr(counter);
        TPWrite ValToStr(Sqrt(-1));
        TPWrite ValToStr(Pow(0, 0));
        TPWrite ValToStr(SqrtDnum(2));
        TryInt 1.5;
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "ERR_ARGVALERR";
        IF ERRNO = ERR_INT_NOTVAL TPWrite "not whole";
        TRYNEXT;
    ENDPROC
ENDMODULE
