! rule: a string ends on its line
! source: [K §2.7]
! at 7: RG207
! at 8: RG207
MODULE Demo
    PROC main()
        TPWrite "abc
        def";
        TPErase;
    ENDPROC
ENDMODULE
