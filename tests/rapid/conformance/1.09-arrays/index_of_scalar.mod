! rule: a scalar has no elements
! source: [K §3.5]
MODULE Demo
    VAR num a;
    PROC main()
        a{1} := 1;  ! -> RG318
    ENDPROC
ENDMODULE
