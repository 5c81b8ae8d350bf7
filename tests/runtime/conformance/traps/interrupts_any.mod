MODULE interrupts_any
! source: K 8 any number; [mem] 100, then ERR_INOMAX
! dialect: interrupts_limited=false
  VAR intnum many{110};
  PROC main()
    VAR num n := 0;
    FOR i FROM 1 TO 110 DO
      CONNECT many{i} WITH nothing;
      Incr n;
    ENDFOR
    TPWrite ValToStr(n);
    ! expect: 110
  ERROR
    IF ERRNO = ERR_INOMAX THEN
      TPWrite ValToStr(n);
      RETURN;
    ENDIF
  ENDPROC
  TRAP nothing
  ENDTRAP
ENDMODULE
