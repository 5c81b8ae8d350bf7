! rule: a call is no target
! source: [K §4.4]
MODULE Demo
    PROC main()
        Abs(1) := 2;  ! -> RG201
    ENDPROC
ENDMODULE
