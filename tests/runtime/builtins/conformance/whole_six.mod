MODULE whole_six
    ! source: S4 datasys 3-ValToStr-1 [manual]: 6 significant digits; Keyence's CV-X modules [code]
    ! expect: 3.02E+06 1.52099E+06 [1,-1.23457E+06,0.5]
    ! expect: 1.67772E+07
    PROC main()
        VAR pos place := [1,-1234567,0.5];
        TPWrite ValToStr(3020000) + " " + ValToStr(1520989) + " " \Pos:=place;
        TPWrite ValToStr(16777216);
    ENDPROC
ENDMODULE
