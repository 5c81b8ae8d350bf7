! rule: an initial value has the declared sizes
! source: [K §2.22]
MODULE Demo
    VAR num a{3} := [1, 2, 3];
    VAR num b{2, 2} := [[1, 2], [3, 4]];
    VAR num c{3} := [1, 2];  ! -> RG318
    VAR num d{2, 2} := [[1, 2], [3]];  ! -> RG318
ENDMODULE
