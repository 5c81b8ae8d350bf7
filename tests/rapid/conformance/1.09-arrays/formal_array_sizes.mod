! rule: a parameter has stars for sizes
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(num v{3})  ! -> RG201
    ENDPROC
ENDMODULE
