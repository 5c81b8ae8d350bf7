! rule: members have the types of the components
! source: [K §3.9]
MODULE Demo
    VAR pos p;
    PROC main()
        p := [1, "2", 3];  ! -> RG307
    ENDPROC
ENDMODULE
