MODULE letters
    ! source: [manual] S4 StrMap: what is not mapped is copied; S4 string: STR_LOWER has the letters of STR_UPPER and, last,
    ! two more, \DF and \FF; [code] loggers and readers of settings map STR_LOWER to STR_UPPER
    ! case:
    ! expect: ROBOT 1
    ! expect: robot 1
    ! expect: TRUE TRUE
    ! No capital stands for these two.
    ! expect: TRUE TRUE
    ! expect: xb
    PROC main()
        TPWrite StrMap("Robot 1", STR_LOWER, STR_UPPER);
        TPWrite StrMap("Robot 1", STR_UPPER, STR_LOWER);
        TPWrite ValToStr(StrMap("\E0\E5\F6\F8\FE", STR_LOWER, STR_UPPER) = "\C0\C5\D6\D8\DE") + " "
            + ValToStr(StrMap("\C0\C5\D6\D8\DE", STR_UPPER, STR_LOWER) = "\E0\E5\F6\F8\FE");
        TPWrite ValToStr(StrMap("\DF\FF", STR_LOWER, STR_UPPER) = "\DF\FF") + " "
            + ValToStr(StrMemb("\DF", 1, STR_LOWER) AND StrMemb("\FF", 1, STR_LOWER));
        TPWrite StrMap("ab", "ab", "x");
    ENDPROC
ENDMODULE
