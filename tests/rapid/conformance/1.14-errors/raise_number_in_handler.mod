! rule: RAISE n does not stand in a handler
! source: [K §4.8]
MODULE Demo
    PROC main()
        TPErase;
    ERROR
        RAISE 5;  ! -> RG321?
    ENDPROC
ENDMODULE
