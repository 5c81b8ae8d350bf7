MODULE error_numbers
! source: [S4 datasys 2-IError, 2-ReadErrData; event log: a code is domain * 10000 + number] with an
! error number only that event of the domain and type interrupts
  VAR intnum one;
  VAR intnum other;
  VAR intnum warned;
  VAR intnum elsewhere;
  VAR trapdata found;
  PROC main()
    CONNECT one WITH told;
    CONNECT other WITH never;
    CONNECT warned WITH never;
    CONNECT elsewhere WITH never;
    IError PROCESS_ERR \ErrorId:=5031, TYPE_ALL, one;
    IError PROCESS_ERR \ErrorId:=5030, TYPE_ALL, other;
    IError PROCESS_ERR \ErrorId:=5031, TYPE_WARN, warned;
    IError SYSTEM_ERR \ErrorId:=5031, TYPE_ALL, elsewhere;
    ErrLog 5031, \I, "title", "a", "b", "c", "d";
    WaitTime 0.1;
    ErrLog 5032, \I, "next", "a", "b", "c", "d";
    WaitTime 0.1;
    TPWrite "end";
    ! expect: 11 5031 1 ErrLog
    ! expect: end
  ENDPROC
  TRAP told
    VAR errdomain domain;
    VAR num number;
    VAR errtype kind;
    VAR string title;
    GetTrapData found;
    ReadErrData found, domain, number, kind \Title:=title;
    TPWrite ValToStr(domain) + " " + ValToStr(number) + " " + ValToStr(kind) + " " + title;
  ENDTRAP
  TRAP never
    TPWrite "never";
  ENDTRAP
ENDMODULE
