! rule: letters outside Latin-1 are in no name
! source: [K §2.1]
MODULE Demo
    PROC main()
        VAR num αβ;  ! -> RG204
    ENDPROC
ENDMODULE
