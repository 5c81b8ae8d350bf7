MODULE arrays_by_value
! source: [K §2.17, 3.5, 4.4] arrays are copied whole; sizes must be equal: ERR_NOTEQDIM
! dialect: unhandled_error=propagate
  VAR num a{3} := [1,2,3];
  CONST num SIZE := 2;
  VAR num m{SIZE,SIZE+1} := [[1,2,3],[4,5,6]];
  PROC main()
    VAR num b{3};
    b := a;
    b{1} := 9;
    TPWrite ValToStr(a) + ValToStr(b) + ValToStr(a = b);
    ! expect: [1,2,3][9,2,3]FALSE
    fill b, 4;
    TPWrite ValToStr(b) + " " + ValToStr(sum(b)) + ValToStr(sum(a));
    ! expect: [4,4,4] 126
    TPWrite ValToStr(Dim(m,1)) + ValToStr(Dim(m,2)) + ValToStr(m{2,1});
    ! expect: 234
    change a;
    TPWrite ValToStr(a);
    ! expect: [1,2,3]
    two a;
    ! expect: sizes differ
    a := [a{3}, a{2}, a{1}];
    TPWrite ValToStr(a);
    ! expect: [3,2,1]
  ERROR
    IF ERRNO = ERR_NOTEQDIM TPWrite "sizes differ";
    TRYNEXT;
  ENDPROC
  PROC fill(VAR num list{*}, num value)
    FOR i FROM 1 TO Dim(list,1) DO
      list{i} := value;
    ENDFOR
  ENDPROC
  FUNC num sum(num list{*})
    VAR num total;
    FOR i FROM 1 TO Dim(list,1) DO
      total := total + list{i};
    ENDFOR
    RETURN total;
  ENDFUNC
  PROC change(num list{*})
    list{1} := 77;
  ENDPROC
  PROC two(num list{*})
    VAR num own{2};
    own := list;
  ENDPROC
ENDMODULE
