! rule: an aggregate has a member for each component
! source: [K §3.9]
MODULE Demo
    VAR pos p;
    PROC main()
        p := [1, 2];  ! -> RG330
    ENDPROC
ENDMODULE
