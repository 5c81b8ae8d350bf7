! rule: whole arrays of one size can be compared
! source: [K §2.17, 3.11]
MODULE Demo
    VAR num a{2};
    VAR num b{2};
    VAR num c{3};
    VAR bool same;
    PROC main()
        same := a = b;
        same := a <> b;
        same := a = [1, 2];
        same := a = c;  ! -> RG318
        same := a = [1, 2, 3];  ! -> RG318
        same := a = 1;  ! -> RG308
    ENDPROC
ENDMODULE
