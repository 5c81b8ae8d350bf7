! rule: arrays of different size are not assigned
! source: [K §2.17]
MODULE Demo
    VAR num a{3};
    VAR num b{4};
    PROC main()
        a := b;  ! -> RG318
    ENDPROC
ENDMODULE
