! rule: arrays of different degree are not assigned
! source: [K §2.17]
MODULE Demo
    VAR num a{3};
    VAR num b{3, 3};
    PROC main()
        a := b;  ! -> RG307
    ENDPROC
ENDMODULE
