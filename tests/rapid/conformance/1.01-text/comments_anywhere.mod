! rule: comments may stand behind code and between its parts
! source: [code] abb_driver and 628 more places
! before
MODULE Demo ! behind the name
    RECORD r ! here
        ! a component
        num x;
    ENDRECORD
    PROC main()
        MoveAbsJ ! which
            [[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]], ! how fast
            v100, fine, tool0;
    ENDPROC
ENDMODULE
! behind
