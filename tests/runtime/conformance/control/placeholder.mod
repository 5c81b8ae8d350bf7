MODULE placeholder
! source: [K §2.9, 12] loads, ERR_EXECPHR when it is reached
  PROC main()
    VAR num n := 1;
    <SMT>
    n := <EXP>;
    TPWrite ValToStr(n);
  ERROR
    TPWrite "EXECPHR " + ValToStr(ERRNO = ERR_EXECPHR);
    TRYNEXT;
    ! expect: EXECPHR TRUE
    ! expect: EXECPHR TRUE
    ! expect: 1
  ENDPROC
ENDMODULE
