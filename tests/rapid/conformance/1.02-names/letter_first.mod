! rule: a name starts with a letter
! source: [K §2.3]
MODULE Demo
    PROC main()
        _a := 1;  ! -> RG204
    ENDPROC
ENDMODULE
