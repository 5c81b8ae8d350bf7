! rule: a component is no array
! source: [K §2.14]
MODULE Demo
    RECORD r
        num x{3};  ! -> RG201
    ENDRECORD
ENDMODULE
