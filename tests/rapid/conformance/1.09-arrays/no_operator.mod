! rule: no other operator takes arrays
! source: [K §3.11]
MODULE Demo
    VAR num a{3};
    PROC main()
        a := a + a;  ! -> RG308
    ENDPROC
ENDMODULE
