MODULE array_bounds
! source: [K §3.5, 12] indices from 1 to the size, whole; ERR_OUTOFBND
  VAR num a{3} := [1,2,3];
  VAR num m{2,2} := [[1,2],[3,4]];
  PROC main()
    VAR num b{3};
    b{0} := 1;
    b{4} := 1;
    b{-1} := 1;
    b{1.5} := 1;
    b{4 / 2} := 9;
    TPWrite ValToStr(b);
    b{1} := a{4};
    b{1} := m{2,3};
    b{1} := m{3,1};
    b{3} := m{2,1};
    TPWrite ValToStr(b);
    ! expect: bound
    ! expect: bound
    ! expect: bound
    ! expect: bound
    ! expect: [0,9,0]
    ! expect: bound
    ! expect: bound
    ! expect: bound
    ! expect: [0,9,3]
  ERROR
    IF ERRNO = ERR_OUTOFBND TPWrite "bound";
    TRYNEXT;
  ENDPROC
ENDMODULE
