MODULE scope
! source: [K §2.20] routine data hide module data hide built-in objects; names have no case
  VAR num Value := 1;
  CONST num pi := 3;
  PROC main()
    VAR num VALUE := 2;
    tpwrite valtostr(value) + " " + ValToStr(PI) + " " + ValToStr(OUTER());
    ! expect: 2 3 1
  ENDPROC
  FUNC num outer()
    RETURN Value;
  ENDFUNC
  FUNC num Abs(num x)
    RETURN 42;
  ENDFUNC
ENDMODULE
