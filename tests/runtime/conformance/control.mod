!=== call_by_var
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
!=== endless_recursion
MODULE endless_recursion
! source: [K §1.4] stack overflow is a fatal execution error: no handler sees it
! fault: 194027 11
  PROC main()
    deeper 1;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC deeper(num n)
    deeper n + 1;
  ENDPROC
ENDMODULE
!=== endless_recursion_in_undo
MODULE endless_recursion_in_undo
! source: [K §1.4] stack overflow is fatal, wherever it happens
! fault: 194027 8
  PROC main()
    again;
  ENDPROC
  PROC again()
    again;
  ERROR
    again;
    RETRY;
  UNDO
    again;
  ENDPROC
ENDMODULE
!=== exit_cycle
MODULE exit_cycle
! source: [S4 datasys 2-ExitCycle-1] data are kept, the call stack is dropped; routine data start afresh
! cycle: 4
  VAR num n := 0;
  PERS num p := 5;
  PROC main()
    VAR num own := 0;
    Incr own;
    Incr n;
    IF n > 4 EXIT;
    TPWrite ValToStr(n) + " " + ValToStr(own);
    deeper;
    TPWrite "never";
    ! expect: 1 1
    ! expect: 2 1
    ! expect: 3 1
    ! expect: 4 1
  ENDPROC
  PROC deeper()
    IF n < 9 ExitCycle;
  ENDPROC
ENDMODULE
!=== exit_ends
MODULE exit_ends
! source: [K §4.9] EXIT ends the task, UNDO runs on the way
  PROC main()
    inner;
    TPWrite "never";
  ENDPROC
  PROC inner()
    EXIT;
    TPWrite "never";
  UNDO
    TPWrite "undo";
    ! expect: undo
  ENDPROC
ENDMODULE
!=== fnc_without_return
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
!=== for_bounds_once
MODULE for_bounds_once
! source: [S4 datasys 2-FOR-2] start, end and step are computed once, before the first pass
  VAR num n := 3;
  PROC main()
    FOR i FROM logged(1) TO logged(n) STEP logged(1) DO
      n := 10;
      TPWrite ValToStr(i);
    ENDFOR
    ! expect: logged 1
    ! expect: logged 3
    ! expect: logged 1
    ! expect: 1
    ! expect: 2
    ! expect: 3
  ENDPROC
  FUNC num logged(num v)
    TPWrite "logged " + ValToStr(v);
    RETURN v;
  ENDFUNC
ENDMODULE
!=== for_counts
MODULE for_counts
! source: [K §4.15] bounds once, no STEP counts down when the end is smaller
  PROC main()
    VAR num n := 3;
    VAR string s;
    FOR i FROM 1 TO n DO
      n := 10;
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 123
    s := "";
    FOR i FROM 3 TO 1 DO
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 321
    s := "";
    FOR i FROM 1 TO 0 DO
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 10
    s := "";
    FOR i FROM 1 TO 3 STEP -1 DO
      s := s + NumToStr(i,0);
    ENDFOR
    TPWrite s;
    ! expect: 1
    s := "";
    FOR i FROM 10 TO 1 STEP -4 DO
      s := s + NumToStr(i,0) + ",";
    ENDFOR
    TPWrite s;
    ! expect: 10,6,2,
    s := "";
    FOR i FROM 0.5 TO 2 STEP 0.5 DO
      s := s + ValToStr(i) + ",";
    ENDFOR
    TPWrite s;
    ! expect: 0.5,1,1.5,2,
  ENDPROC
ENDMODULE
!=== for_tested
MODULE for_tested
! source: [mem] switch for_loop=tested
! dialect: for_loop=tested
  PROC main()
    FOR i FROM 1 TO 0 DO
      TPWrite "never";
    ENDFOR
    FOR i FROM 1 TO 3 STEP -1 DO
      TPWrite "never";
    ENDFOR
    FOR i FROM 2 TO 3 DO
      TPWrite NumToStr(i,0);
    ENDFOR
    ! expect: 2
    ! expect: 3
  ENDPROC
ENDMODULE
!=== for_variable_hides
MODULE for_variable_hides
! source: [K §4.15] the loop variable hides other names and ends with the loop
  VAR num i := 100;
  PROC main()
    VAR num k := 7;
    FOR k FROM 1 TO 2 DO
    ENDFOR
    FOR i FROM 1 TO 2 DO
      show i;
    ENDFOR
    TPWrite ValToStr(k) + " " + ValToStr(i);
    ! expect: 1 100
    ! expect: 2 100
    ! expect: 7 100
  ENDPROC
  PROC show(num n)
    TPWrite ValToStr(n) + " " + ValToStr(i);
  ENDPROC
ENDMODULE
!=== goto
MODULE goto_shown
! source: [K §4.3, 4.6] a label's list may be left and entered again from inside
  PROC main()
    VAR num i := 0;
  again:
    Incr i;
    IF i < 3 GOTO again;
    TPWrite ValToStr(i);
    ! expect: 3
    FOR a FROM 1 TO 5 DO
      FOR c FROM 1 TO 5 DO
        IF a * c = 6 THEN
          TPWrite ValToStr(a) + "*" + ValToStr(c);
          GOTO found;
        ENDIF
      ENDFOR
    ENDFOR
    TPWrite "never";
  found:
    ! expect: 2*3
    WHILE TRUE DO
      Incr i;
    inner:
      i := i + 10;
      IF i < 40 GOTO inner;
      IF i >= 40 GOTO out;
    ENDWHILE
  out:
    TPWrite ValToStr(i);
    ! expect: 44
    GOTO last;
    TPWrite "never";
  last:
  ENDPROC
ENDMODULE
!=== if_first_true
MODULE if_first_true
! source: [K §4.13] conditions in order until one is TRUE; [K §3] AND and OR skip the right side
  VAR num calls := 0;
  FUNC bool yes()
    Incr calls;
    RETURN TRUE;
  ENDFUNC
  PROC main()
    VAR num n := 2;
    IF n = 1 THEN
      TPWrite "one";
    ELSEIF n = 2 THEN
      TPWrite "two";
    ELSEIF yes() THEN
      TPWrite "call";
    ELSE
      TPWrite "else";
    ENDIF
    ! expect: two
    IF n = 3 AND yes() TPWrite "never";
    IF n = 2 OR yes() TPWrite "or";
    ! expect: or
    TPWrite ValToStr(calls);
    ! expect: 0
    IF n = 9 THEN
    ELSEIF yes() THEN
      TPWrite "late";
    ENDIF
    ! expect: late
    IF (n = 2) XOR yes() THEN
      TPWrite "never";
    ELSE
      TPWrite ValToStr(calls);
    ENDIF
    ! expect: 2
  ENDPROC
ENDMODULE
!=== late_binding
MODULE late_binding
! source: [K §4.5, 12] name, module:name, :name; ERR_REFUNKPRC, ERR_CALLPROC
  VAR num total := 0;
  PROC show(num n \switch twice)
    TPWrite "show " + ValToStr(n) + " " + ValToStr(Present(twice));
  ENDPROC
  PROC bump(INOUT num n, num by)
    n := n + by;
  ENDPROC
  LOCAL PROC hidden()
    TPWrite "hidden";
  ENDPROC
  FUNC num f()
    RETURN 1;
  ENDFUNC
  PROC main()
    VAR num n := 1;
    %"sho" + "w"% n;
    ! expect: show 1 FALSE
    %"SHOW"% 2 \twice;
    ! expect: show 2 TRUE
    %"bump"% n, 4;
    %"bump"% total, n;
    TPWrite ValToStr(n) + " " + ValToStr(total);
    ! expect: 5 5
    %"late_binding:hidden"%;
    ! expect: hidden
    %":main2"%;
    ! expect: main2
    %"TPWrite"% "built in";
    ! expect: built in
    %"missing"%;
    ! expect: REFUNKPRC
    %"f"%;
    ! expect: CALLPROC
    %"a b"%;
    ! expect: CALLPROC
    CallByVar "proc", 7;
    ! expect: proc7
    CallByVar "proc", 8;
    ! expect: REFUNKPRC
  ERROR
    IF ERRNO = ERR_REFUNKPRC TPWrite "REFUNKPRC";
    IF ERRNO = ERR_CALLPROC TPWrite "CALLPROC";
    TRYNEXT;
  ENDPROC
  PROC main2()
    TPWrite "main2";
  ENDPROC
  PROC proc7()
    TPWrite "proc7";
  ENDPROC
ENDMODULE
!=== next_cycle
MODULE next_cycle
! source: [S4 overview 4-24] end of main starts main again without initialising variables
! cycle: 3
  VAR num n := 0;
  PROC main()
    Incr n;
    TPWrite ValToStr(n);
    ! expect: 1
    ! expect: 2
    ! expect: 3
  ENDPROC
ENDMODULE
!=== placeholder
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
!=== recursion
MODULE recursion
! source: [K §2.21] routine data are one instance per recursive call
  PROC main()
    VAR num n := 0;
    TPWrite ValToStr(fac(6)) + " " + walk(3);
    ! expect: 720 3(2(1(0)1)2)3
    nest 2000, n;
    TPWrite ValToStr(n);
    ! expect: 2.001E+06
  ENDPROC
  FUNC num fac(num n)
    IF n <= 1 RETURN 1;
    RETURN n * fac(n - 1);
  ENDFUNC
  FUNC string walk(num n)
    VAR num mine;
    VAR string inside;
    mine := n;
    IF n = 0 RETURN "0";
    inside := walk(n - 1);
    RETURN NumToStr(mine,0) + "(" + inside + ")" + NumToStr(mine,0);
  ENDFUNC
  PROC nest(num depth, INOUT num total)
    IF depth = 0 RETURN;
    total := total + depth;
    nest depth - 1, total;
  ENDPROC
ENDMODULE
!=== test_cases
MODULE test_cases
! source: [K §4.17, S4 datasys 2-TEST-1] first match only, any value type, no fall-through
  PROC main()
    VAR string s := "b";
    VAR pos p := [1,2,3];
    TEST s
    CASE "a", "b":
      TPWrite "ab";
    CASE "b":
      TPWrite "never";
    DEFAULT:
      TPWrite "never";
    ENDTEST
    ! expect: ab
    TEST p
    CASE [1,2,4]:
      TPWrite "never";
    CASE [1,2,3]:
      TPWrite "pos";
    ENDTEST
    ! expect: pos
    TEST 7
    CASE 1, 2:
      TPWrite "never";
    ENDTEST
    TEST 7
    CASE 1:
    DEFAULT:
      TPWrite "default";
    ENDTEST
    ! expect: default
  ENDPROC
ENDMODULE
!=== while_tests_first
MODULE while_tests_first
! source: [K §4.16]
  PROC main()
    VAR num n := 3;
    WHILE n > 3 DO
      TPWrite "never";
    ENDWHILE
    WHILE n > 0 DO
      n := n - 2;
    ENDWHILE
    TPWrite ValToStr(n);
    ! expect: -1
    WHILE down(n) DO
    ENDWHILE
    TPWrite ValToStr(n);
    ! expect: -3
  ENDPROC
  FUNC bool down(INOUT num n)
    n := n - 1;
    RETURN n > -3;
  ENDFUNC
ENDMODULE
