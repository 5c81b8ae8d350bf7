MODULE strings
! source: [K §2.13, 3.11] at most 80 characters, ERR_STRTOOLNG; comparison counts case
  PROC main()
    VAR string s := "0123456789012345678901234567890123456789";
    VAR string t;
    t := s + s;
    TPWrite ValToStr(StrLen(t));
    ! expect: 80
    t := t + "x";
    ! expect: too long
    TPWrite ValToStr(StrLen(t)) + ValToStr("a" = "A") + ValToStr("" = t);
    ! expect: 80FALSEFALSE
    TPWrite "\41\\""";
    ! expect: A\"
  ERROR
    IF ERRNO = ERR_STRTOOLNG TPWrite "too long";
    TRYNEXT;
  ENDPROC
ENDMODULE
