! rule: indices start from 1
! source: [K §3.5]; loaded as behind the end (index_too_large): the error comes when it is executed
MODULE Demo
    VAR num a{3};
    PROC main()
        a{0} := 1;  ! -> RG318?
    ENDPROC
ENDMODULE
