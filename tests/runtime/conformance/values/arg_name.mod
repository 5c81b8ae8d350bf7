MODULE arg_name
! source: [S4 datasys 3-ArgName-1..3] the original datum's name, through any number of calls
  VAR num original := 1;
  VAR num list{3} := [1,2,3];
  VAR pos where := [1,2,3];
  PROC main()
    outer original;
    outer list{2};
    outer where.y;
    outer 1 + 2;
    ! expect: original
    ! expect: list
    ! expect: where
    ! expect: no name
  ENDPROC
  PROC outer(num first)
    inner first;
  ENDPROC
  PROC inner(num second)
    TPWrite ArgName(second);
  ERROR
    IF ERRNO = ERR_ARGNAME TPWrite "no name";
    TRYNEXT;
  ENDPROC
ENDMODULE
