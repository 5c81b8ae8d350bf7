MODULE next_cycle
! source: [S4 overview 4-24] end of main starts main again without initialising variables
! cycle: 3
  VAR num n := 0;
  PROC main()
    Incr n;
    TPWrite ValToStr(n);
    ! expect: 1
    ! expect: 2
    ! expect: 3
  ENDPROC
ENDMODULE
