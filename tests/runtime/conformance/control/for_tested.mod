MODULE for_tested
! source: [mem] switch for_loop=tested
! dialect: for_loop=tested
  PROC main()
    FOR i FROM 1 TO 0 DO
      TPWrite "never";
    ENDFOR
    FOR i FROM 1 TO 3 STEP -1 DO
      TPWrite "never";
    ENDFOR
    FOR i FROM 2 TO 3 DO
      TPWrite NumToStr(i,0);
    ENDFOR
    ! expect: 2
    ! expect: 3
  ENDPROC
ENDMODULE
