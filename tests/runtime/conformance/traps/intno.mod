MODULE intno
! source: [S4 overview 4-39] INTNO tells which interrupt it is; several may share one trap
  VAR intnum first;
  VAR intnum second;
  PERS num p := 0;
  PERS num q := 0;
  PROC main()
    CONNECT first WITH t;
    CONNECT second WITH t;
    IPers p, first;
    IPers q, second;
    q := 1;
    WaitTime 0.1;
    p := 1;
    WaitTime 0.1;
    ! expect: second
    ! expect: first
  ENDPROC
  TRAP t
    IF INTNO = first TPWrite "first";
    IF INTNO = second TPWrite "second";
  ENDTRAP
ENDMODULE
