MODULE ordered_twice
! source: [S4 datasys 2-ISignalDI] a second order without IDelete is not allowed
! fault: 40214 9
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    IPers p, i;
    TPWrite "never";
  ENDPROC
  TRAP t
  ENDTRAP
ENDMODULE
