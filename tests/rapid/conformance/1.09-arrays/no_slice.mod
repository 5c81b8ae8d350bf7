! rule: an element is named with all its indices
! source: [K §3.5]
MODULE Demo
    VAR num a{3, 3};
    VAR num b{3};
    PROC main()
        b := a{1};  ! -> RG318
    ENDPROC
ENDMODULE
