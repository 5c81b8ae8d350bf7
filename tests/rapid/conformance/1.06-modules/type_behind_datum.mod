! rule: no type behind a datum
! source: [K §5, 9.1]
MODULE Demo
    VAR num a;
    ALIAS num n;  ! -> RG213
ENDMODULE
