MODULE for_bounds_once
! source: [S4 datasys 2-FOR-2] start, end and step are computed once, before the first pass
  VAR num n := 3;
  PROC main()
    FOR i FROM told(1) TO told(n) STEP told(1) DO
      n := 10;
      TPWrite ValToStr(i);
    ENDFOR
    ! expect: told 1
    ! expect: told 3
    ! expect: told 1
    ! expect: 1
    ! expect: 2
    ! expect: 3
  ENDPROC
  FUNC num told(num v)
    TPWrite "told " + ValToStr(v);
    RETURN v;
  ENDFUNC
ENDMODULE
