! rule: an aggregate has a member for each element of the array
! source: [K §2.17, 3.9]
MODULE Demo
    VAR num a{2};
    VAR num b{2,3};
    PROC main()
        a := [1, 2];
        a := [1, 2, 3];  ! -> RG318
        b := [[1, 2, 3], [4, 5, 6]];
        b := [[1, 2], [3, 4]];  ! -> RG318 RG318
    ENDPROC
ENDMODULE
