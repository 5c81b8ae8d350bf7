! rule: non-value types are VAR parameters
! source: [K §2.16]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(clock c)  ! -> RG328
    ENDPROC
ENDMODULE
