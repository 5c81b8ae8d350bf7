! rule: one to three dimensions, of constant sizes
! source: [K §2.22]
MODULE Demo
    CONST num n := 2;
    VAR num a{n};
    VAR num b{n, 2 * n};
    VAR num c{1, 2, 3};
ENDMODULE
