! rule: at most one handler of a kind
! source: [K §5.3]
MODULE Demo
    PROC main()
    ERROR
        TRYNEXT;
    ERROR  ! -> RG216
        TRYNEXT;
    ENDPROC
ENDMODULE
