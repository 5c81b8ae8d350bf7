! rule: no datum is a switch
! source: [K §5.1]
MODULE Demo
    VAR switch a;  ! -> RG303
ENDMODULE
