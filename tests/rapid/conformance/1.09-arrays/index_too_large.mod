! rule: an index lies within the size
! source: [K §3.5]
MODULE Demo
    CONST num n := 3;
    VAR num a{n};
    PROC main()
        a{n + 1} := 1;  ! -> RG318
    ENDPROC
ENDMODULE
