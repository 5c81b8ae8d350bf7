MODULE optional_absent
! source: [K §5.1, 11, 12] an absent optional parameter may not be read or set: ERR_NOTPRES
  PROC main()
    show \n:=3;
    show;
    pass \n:=4;
    pass;
    ! expect: 3
    ! expect: absent
    ! expect: NOTPRES
    ! expect: 4
    ! expect: absent
    ! expect: NOTPRES
    both;
    both \a:=1;
    both \b:="x";
    ! expect: FALSE FALSE
    ! expect: TRUE FALSE
    ! expect: FALSE TRUE
  ENDPROC
  PROC show(\num n)
    IF NOT Present(n) TPWrite "absent";
    TPWrite ValToStr(n + 0);
  ERROR
    IF ERRNO = ERR_NOTPRES TPWrite "NOTPRES";
    TRYNEXT;
  ENDPROC
  PROC pass(\num n)
    show \n?n;
  ENDPROC
  PROC both(\num a | string b)
    TPWrite ValToStr(Present(a)) + " " + ValToStr(Present(b));
  ENDPROC
ENDMODULE
