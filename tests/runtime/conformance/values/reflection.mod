MODULE reflection
! source: [K §11, S4 datasys 3-Present-1, 3-Dim-1, 3-IsPers-1] what a routine can ask of its arguments
  PERS num kept := 1;
  VAR num plain := 1;
  VAR num table{2,5};
  PROC main()
    ask kept;
    ask plain;
    ask plain \flag;
    ask plain \opt:=3;
    sizes table;
    ! expect: pers FALSEFALSETRUE
    ! expect: var FALSEFALSETRUE
    ! expect: var TRUEFALSETRUE
    ! expect: var FALSETRUETRUE
    ! expect: 2 5
    ! expect: no dimension 3
  ENDPROC
  PROC ask(INOUT num v \switch flag \num opt)
    VAR string kind := "?";
    IF IsPers(v) kind := "pers ";
    IF IsVar(v) kind := "var ";
    TPWrite kind + ValToStr(Present(flag)) + ValToStr(Present(opt)) + ValToStr(Present(v));
  ENDPROC
  PROC sizes(num a{*,*})
    TPWrite ValToStr(Dim(a,1)) + " " + ValToStr(Dim(a,2));
    TPWrite ValToStr(Dim(a,3));
  ERROR
    IF ERRNO = ERR_ILLDIM TPWrite "no dimension 3";
    TRYNEXT;
  ENDPROC
ENDMODULE
