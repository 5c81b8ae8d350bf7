MODULE late_binding
! source: [K §4.5, 12] name, module:name, :name; ERR_REFUNKPRC, ERR_CALLPROC
  VAR num total := 0;
  PROC show(num n \switch twice)
    TPWrite "show " + ValToStr(n) + " " + ValToStr(Present(twice));
  ENDPROC
  PROC bump(INOUT num n, num by)
    n := n + by;
  ENDPROC
  LOCAL PROC hidden()
    TPWrite "hidden";
  ENDPROC
  FUNC num f()
    RETURN 1;
  ENDFUNC
  PROC main()
    VAR num n := 1;
    %"sho" + "w"% n;
    ! expect: show 1 FALSE
    %"SHOW"% 2 \twice;
    ! expect: show 2 TRUE
    %"bump"% n, 4;
    %"bump"% total, n;
    TPWrite ValToStr(n) + " " + ValToStr(total);
    ! expect: 5 5
    %"late_binding:hidden"%;
    ! expect: hidden
    %":main2"%;
    ! expect: main2
    %"TPWrite"% "built in";
    ! expect: built in
    %"nobody"%;
    ! expect: REFUNKPRC
    %"f"%;
    ! expect: CALLPROC
    %"a b"%;
    ! expect: CALLPROC
    CallByVar "proc", 7;
    ! expect: proc7
    CallByVar "proc", 8;
    ! expect: REFUNKPRC
  ERROR
    IF ERRNO = ERR_REFUNKPRC TPWrite "REFUNKPRC";
    IF ERRNO = ERR_CALLPROC TPWrite "CALLPROC";
    TRYNEXT;
  ENDPROC
  PROC main2()
    TPWrite "main2";
  ENDPROC
  PROC proc7()
    TPWrite "proc7";
  ENDPROC
ENDMODULE
