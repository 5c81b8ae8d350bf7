MODULE fnc_without_return
! source: [K §5.4, 12] a FUNC that ends without RETURN: ERR_FNCNORET
! dialect: unhandled_error=propagate
  FUNC num f(bool go)
    IF go RETURN 1;
  ENDFUNC
  PROC main()
    TPWrite ValToStr(f(TRUE));
    ! expect: 1
    TPWrite ValToStr(f(FALSE));
  ERROR
    TPWrite "FNCNORET " + ValToStr(ERRNO = ERR_FNCNORET);
    TRYNEXT;
    ! expect: FNCNORET TRUE
  ENDPROC
ENDMODULE
