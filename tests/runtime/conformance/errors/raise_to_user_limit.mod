MODULE user
! source: [K §7.3, 7.5] a statement has its retries, whoever says RETRY
! fault: ERR_EXCRTYMAX 28
  PROC main()
    fails;
    ! expect: user
    ! expect: user
    ! expect: user
    ! expect: user
    ! expect: user
    ! expect: 55
    ! expect: user
  ERROR
    TPWrite "user";
    RETRY;
  ENDPROC
ENDMODULE
MODULE hidden(NOSTEPIN)
  PROC fails()
    VAR num z;
    WHILE TRUE DO
      z := z + 1;
      IF z = 2 RETURN;
      TPRead;
    ENDWHILE
  ENDPROC
  PROC TPRead()
    RAISE 5;
  ERROR
    IF ERRNO <> 5 TPWrite "55";
    RaiseToUser \Continue;
  ENDPROC
ENDMODULE
