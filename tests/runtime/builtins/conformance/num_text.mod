MODULE num_text
    ! source: [manual] S4 ValToStr, TPWrite, NumToStr; exponents [mem]
    ! expect: 23
    ! expect: 1.14137
    ! expect: [1817.3,905.17,879.11]
    ! expect: TRUE
    ! expect: "text"
    ! expect: 0.123456789012345
    ! expect: 9E+09
    ! expect: n=0.3
    ! expect: d=0.1
    ! expect: p=[1,2,3]
    ! expect: 0.385 3.85E-01
    ! expect: 1
    ! expect: ERR_STRTOOLNG
    VAR num long{16} := [1.5,2.5,3.5,4.5,5.5,6.5,7.5,8.5,9.5,10.55,11.55,12.55,13.55,14.55,15.5555,16.5555];
    PERS num shared := 1;

    PROC main()
        VAR pos p := [1817.3,905.17,879.11];
        VAR dnum d := 0.123456789012345;
        VAR num n := 1.141367;
        TPWrite ValToStr(23);
        TPWrite ValToStr(n);
        TPWrite ValToStr(p);
        TPWrite ValToStr(TRUE);
        TPWrite ValToStr("text");
        TPWrite ValToStr(d);
        TPWrite ValToStr(9E9);
        TPWrite "n="\Num:=0.1 + 0.2;
        TPWrite "d="\Dnum:=0.1;
        TPWrite "p="\Pos:=[1,2,3];
        TPWrite NumToStr(0.38521, 3) + " " + NumToStr(0.38521, 2\Exp);
        TPWrite ValToStr(shared);
        TPWrite ValToStr(long);
    ERROR
        IF ERRNO = ERR_STRTOOLNG TPWrite "ERR_STRTOOLNG";
        TRYNEXT;
    ENDPROC
ENDMODULE
