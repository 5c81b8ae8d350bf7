MODULE for_counts
! source: [K §4.15] bounds once, no STEP counts down when the end is smaller
  PROC main()
    VAR num n := 3;
    VAR string s;
    FOR i FROM 1 TO n DO
      n := 10;
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 123
    s := "";
    FOR i FROM 3 TO 1 DO
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 321
    s := "";
    FOR i FROM 1 TO 0 DO
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 10
    s := "";
    FOR i FROM 1 TO 3 STEP -1 DO
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 1
    s := "";
    FOR i FROM 10 TO 1 STEP -4 DO
      s := s + NumToStr(i,0) + ",";
    ENDFOR
    TPWrite s;
    ! expect: 10,6,2,
    s := "";
    FOR i FROM 0.5 TO 2 STEP 0.5 DO
      s := s + ValToStr(i) + ",";
    ENDFOR
    TPWrite s;
    ! expect: 0.5,1,1.5,2,
  ENDPROC
ENDMODULE
