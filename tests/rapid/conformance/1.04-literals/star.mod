! rule: * in place of a position
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        MoveL *, v100, fine, tool0;
    ENDPROC
ENDMODULE
