MODULE call_by_var
! source: [S4 datasys 2-CallByVar-1,2] name and number make the name of a procedure
  VAR num data7 := 1;
  PROC main()
    CallByVar "proc", 1;
    CallByVar "proc", 12;
    CallByVar "proc", 3;
    CallByVar "data", 7;
    CallByVar "proc", 1.5;
    TPWrite "end";
    ! expect: one
    ! expect: twelve
    ! expect: unknown
    ! expect: no procedure
    ! expect: not whole
    ! expect: end
  ERROR
    TEST ERRNO
    CASE ERR_REFUNKPRC:
      TPWrite "unknown";
    CASE ERR_CALLPROC:
      TPWrite "no procedure";
    DEFAULT:
      TPWrite "not whole";
    ENDTEST
    TRYNEXT;
  ENDPROC
  PROC proc1()
    TPWrite "one";
  ENDPROC
  PROC proc12()
    TPWrite "twelve";
  ENDPROC
ENDMODULE
