! rule: a procedure is called without parentheses
! source: [K §4.5]
MODULE Demo
    PROC main()
        p();  ! -> RG201
    ENDPROC
    PROC p()
    ENDPROC
ENDMODULE
