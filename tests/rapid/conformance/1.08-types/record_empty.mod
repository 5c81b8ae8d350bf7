! rule: a record has at least one component
! source: [K §2.14]
MODULE Demo
    RECORD r
    ENDRECORD  ! -> RG201
ENDMODULE
