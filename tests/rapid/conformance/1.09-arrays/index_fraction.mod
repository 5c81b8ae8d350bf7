! rule: an index is whole
! source: [K §3.5]
MODULE Demo
    VAR num a{3};
    PROC main()
        a{1.5} := 1;  ! -> RG318
    ENDPROC
ENDMODULE
