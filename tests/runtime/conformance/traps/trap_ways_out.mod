MODULE trap_ways_out
! source: [S4 overview 4-39] a trap ends with RETURN or ENDTRAP, then the interrupted place goes on
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    VAR num n := 5;
    CONNECT i WITH t;
    IPers p, i;
    p := 1;
    WaitTime 0.1;
    TPWrite "went on " + ValToStr(n);
    p := 2;
    WaitTime 0.1;
    TPWrite "went on " + ValToStr(n);
    p := 3;
    WaitTime 0.1;
    TPWrite "end";
    ! expect: trap 1
    ! expect: went on 5
    ! expect: trap 2
    ! expect: endtrap
    ! expect: went on 5
    ! expect: trap 3
    ! expect: handled
    ! expect: end
  ENDPROC
  TRAP t
    VAR num n := 7;
    TPWrite "trap " + ValToStr(p);
    IF p = 1 RETURN;
    IF p = 3 RAISE 5;
    TPWrite "endtrap";
  ERROR
    TPWrite "handled";
    RETURN;
  ENDTRAP
ENDMODULE
