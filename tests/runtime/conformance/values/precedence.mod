MODULE precedence
! source: [K §3] * / DIV MOD, + -, relations, AND, then OR XOR NOT; left to right
  PROC main()
    TPWrite ValToStr(2 + 3 * 4) + " " + ValToStr(20 - 5 - 3) + " " + ValToStr(24 / 4 / 2);
    ! expect: 14 12 3
    TPWrite ValToStr(-2 * 3) + " " + ValToStr(-2 + 5) + " " + ValToStr(7 - 2 * 3 + 1);
    ! expect: -6 3 2
    TPWrite ValToStr(TRUE OR FALSE AND FALSE);
    ! expect: TRUE
    TPWrite ValToStr(NOT FALSE AND FALSE);
    ! expect: TRUE
    TPWrite ValToStr(NOT 1 = 2);
    ! expect: TRUE
    TPWrite ValToStr(1 + 1 = 2 AND 2 < 3);
    ! expect: TRUE
  ENDPROC
ENDMODULE
