! rule: a num literal fits single precision
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1E39;  ! -> RG319
    ENDPROC
ENDMODULE
