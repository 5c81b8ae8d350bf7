! rule: an exponent out of range is an error of the text
! source: [K §1.4, 2.5]
MODULE Demo
    PROC main()
        elsewhere := 2E52786;  ! -> RG205
    ENDPROC
ENDMODULE
