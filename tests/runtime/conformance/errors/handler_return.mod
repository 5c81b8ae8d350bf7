MODULE handler_return
! source: [K §4.7, 7.1] RETURN in a handler leaves the routine; a function gives its value
  PROC main()
    TPWrite ValToStr(safe(0)) + " " + ValToStr(safe(4));
    ! expect: -1 2.5
    leave;
    TPWrite "after";
    ! expect: after
  ENDPROC
  FUNC num safe(num d)
    RETURN 10 / d;
  ERROR
    RETURN -1;
  ENDFUNC
  PROC leave()
    VAR num z;
    z := 1 / z;
    TPWrite "never";
  ERROR
    RETURN;
  ENDPROC
ENDMODULE
