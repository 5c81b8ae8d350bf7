! rule: an alias names no alias
! source: [K §2.15]
MODULE Demo
    ALIAS num a;
    ALIAS a b;  ! -> RG327
ENDMODULE
