! rule: REF parameters exist in predefined routines only
! source: [K §5.1]
MODULE Demo
    PROC p(REF num a)  ! -> RG201
    ENDPROC
ENDMODULE
