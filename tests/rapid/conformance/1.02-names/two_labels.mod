! rule: labels of one routine have different names
! source: [K §4.3]
MODULE Demo
    PROC main()
        again:
        again:  ! -> RG305
        GOTO again;
    ENDPROC
ENDMODULE
