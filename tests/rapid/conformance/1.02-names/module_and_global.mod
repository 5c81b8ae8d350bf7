! rule: a module and a global object of its task differ
! source: [K §2.12]
! given: system
! at 8: RG305
MODULE Demo
    PROC main()
    ENDPROC
    PROC Demo()
    ENDPROC
ENDMODULE
