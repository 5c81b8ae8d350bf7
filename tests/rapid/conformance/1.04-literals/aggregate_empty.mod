! rule: an aggregate has at least one member
! source: [K §3.9]
MODULE Demo
    VAR pos p;
    PROC main()
        p := [];  ! -> RG201
    ENDPROC
ENDMODULE
