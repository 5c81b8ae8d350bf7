MODULE for_variable_hides
! source: [K §4.15] the loop variable hides other names and ends with the loop
  VAR num i := 100;
  PROC main()
    VAR num k := 7;
    FOR k FROM 1 TO 2 DO
    ENDFOR
    FOR i FROM 1 TO 2 DO
      show i;
    ENDFOR
    TPWrite ValToStr(k) + " " + ValToStr(i);
    ! expect: 1 100
    ! expect: 2 100
    ! expect: 7 100
  ENDPROC
  PROC show(num n)
    TPWrite ValToStr(n) + " " + ValToStr(i);
  ENDPROC
ENDMODULE
