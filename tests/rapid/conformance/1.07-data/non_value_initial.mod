! rule: a non-value type takes no initial value
! source: [K §2.22]
MODULE Demo
    VAR clock c := 0;  ! -> RG309
ENDMODULE
