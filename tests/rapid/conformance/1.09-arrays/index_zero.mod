! rule: indices start from 1
! source: [K §3.5]
MODULE Demo
    VAR num a{3};
    PROC main()
        a{0} := 1;  ! -> RG318
    ENDPROC
ENDMODULE
