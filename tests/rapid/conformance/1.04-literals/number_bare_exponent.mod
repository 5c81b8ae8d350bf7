! rule: an exponent has digits
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1E;  ! -> RG205
    ENDPROC
ENDMODULE
