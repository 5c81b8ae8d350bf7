MODULE helpers(NOSTEPIN)
    ! source: [S4 overview 4-8, K §9.1] such a module runs as a whole, but for what it calls elsewhere
    ! do: step
    ! expect: 1
    ! at: back TPWrite "b";
    ! do: step
    ! expect: b
    ! expect: 2
    ! at: main TPWrite "3";
    ! do: step
    ! expect: 3
    ! at: finished
    PROC helper()
        TPWrite "1";
        back;
        TPWrite "2";
    ENDPROC
ENDMODULE
MODULE user
  PROC main()
    helper;
    TPWrite "3";
  ENDPROC
  PROC back()
    TPWrite "b";
  ENDPROC
ENDMODULE
