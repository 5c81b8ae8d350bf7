! rule: an index is num
! source: [K §3.5]
MODULE Demo
    VAR num a{3};
    PROC main()
        a{"1"} := 1;  ! -> RG307
    ENDPROC
ENDMODULE
