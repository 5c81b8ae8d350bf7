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
