MODULE fault_stops_normal
! source: [S4 overview 4-45] a fault of a NORMAL task stops the other NORMAL tasks
! task: T_TWO second
! until: 3
! fault: ERR_DIVZERO 15
  PROC main()
    WaitTime 2;
    TPWrite "never";
  ENDPROC
  PROC second()
    VAR num z;
    WaitTime 1;
    TPWrite "divides";
    ! expect: divides
    z := 1 / z;
  ENDPROC
ENDMODULE
