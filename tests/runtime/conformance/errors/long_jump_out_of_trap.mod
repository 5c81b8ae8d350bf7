MODULE long_jump_out_of_trap
! source: [K §7.2] a long jump may leave a trap: a listed handler below it takes the error, also
! when the trap came between two statements; TRYNEXT goes on there
  VAR intnum late;
  VAR num n := 0;
  VAR num sum := 0;
  PROC main()
    CONNECT late WITH on_late;
    ITimer \Single, 0.1, late;
    WHILE n < 30000 DO
      n := n + 1;
      sum := sum + 2;
    ENDWHILE
    TPWrite "whole: " + ValToStr(sum = 2 * n AND n = 30000);
    IDelete late;
    CONNECT late WITH on_late;
    ITimer \Single, 0.1, late;
    leave;
    TPWrite "main goes on";
    ! expect: trap
    ! expect: caught 7
    ! expect: whole: TRUE
    ! expect: trap
    ! expect: left
    ! expect: main goes on
  ERROR (7)
    TPWrite "caught " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC leave()
    WHILE TRUE DO
      n := n + 1;
    ENDWHILE
  ERROR (7)
    TPWrite "left";
    RETURN;
  ENDPROC
  TRAP on_late
    TPWrite "trap";
    bad;
  ERROR
    RAISE;
  ENDTRAP
  PROC bad()
    RAISE 7;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
