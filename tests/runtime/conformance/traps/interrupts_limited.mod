MODULE interrupts_limited
! source: K 8 any number; [mem] 100, then ERR_INOMAX
  VAR intnum many{110};
  PROC main()
    VAR num n := 0;
    FOR i FROM 1 TO 110 DO
      CONNECT many{i} WITH nothing;
      Incr n;
    ENDFOR
    TPWrite ValToStr(n);
    ! expect: 100
  ERROR
    IF ERRNO = ERR_INOMAX THEN
      TPWrite ValToStr(n);
      RETURN;
    ENDIF
  ENDPROC
  TRAP nothing
  ENDTRAP
ENDMODULE
