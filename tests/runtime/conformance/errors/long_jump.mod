MODULE long_jump
! source: [K §7.2] a listed handler far up beats a plain ERROR nearer by; UNDO of what is dropped runs
  PROC main()
    TPWrite "start";
    far 7;
    TPWrite "between";
    far 8;
    TPWrite "end";
    ! expect: start
    ! expect: inner 7
    ! expect: undo middle
    ! expect: far 7
    ! expect: after the call
    ! expect: between
    ! expect: inner 8
    ! expect: plain 8
    ! expect: after inner
    ! expect: after the call
    ! expect: end
  ENDPROC
  PROC far(num n)
    middle n;
    TPWrite "after the call";
  ERROR (7)
    TPWrite "far " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC middle(num n)
    inner n;
    TPWrite "after inner";
  ERROR
    TPWrite "plain " + ValToStr(ERRNO);
    TRYNEXT;
  UNDO
    TPWrite "undo middle";
  ENDPROC
  PROC inner(num n)
    RAISE n;
  ERROR
    TPWrite "inner " + ValToStr(ERRNO);
    RAISE;
  ENDPROC
ENDMODULE
