! rule: a leading switch is followed by a comma
! source: [K §4.5]
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PROC main()
        MoveL \Conc, p, v100, fine, tool0;
    ENDPROC
ENDMODULE
