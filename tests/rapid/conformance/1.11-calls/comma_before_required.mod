! rule: a comma stands before a required argument
! source: [K §3.10]
MODULE Demo
    PROC main()
        ErrWrite \W "a", "b";  ! -> RG201
    ENDPROC
ENDMODULE
