MODULE long_jump_of_bare
! source: [K §7.1, 7.2] an error in a routine without ERROR goes to the caller: first to the recovery
! point that lists it, however far; plain handlers between do not run, UNDO of what is dropped does
! dialect: unhandled_error=propagate
  PROC main()
    far 7;
    far 8;
    division;
    TPWrite "end";
    ! expect: undo inner
    ! expect: undo middle
    ! expect: far 7
    ! expect: after the call
    ! expect: plain 8
    ! expect: after inner
    ! expect: after the call
    ! expect: undo divide
    ! expect: far division
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
  UNDO
    TPWrite "undo inner";
  ENDPROC
  PROC division()
    between;
  ERROR (ERR_DIVZERO)
    TPWrite "far division";
    TRYNEXT;
  ENDPROC
  PROC between()
    divide 0;
  ERROR
    TPWrite "plain division";
    TRYNEXT;
  ENDPROC
  PROC divide(num n)
    n := 1 / n;
  UNDO
    TPWrite "undo divide";
  ENDPROC
ENDMODULE
