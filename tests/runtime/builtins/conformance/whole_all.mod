MODULE whole_all
    ! source: S4 datasys 3-ValToStr-1 [manual]: 6 significant digits; Keyence's CV-X modules [code]
    ! dialect: whole_text=all
    ! expect: 3020000 1520989 [1,-1234567,0.5]
    ! expect: 1.67772E+07
    PROC main()
        VAR pos place := [1,-1234567,0.5];
        TPWrite ValToStr(3020000) + " " + ValToStr(1520989) + " " \Pos:=place;
        TPWrite ValToStr(16777216);
    ENDPROC
ENDMODULE
