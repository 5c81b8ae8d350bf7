! rule: a non-value is not assigned
! source: [K §2.16]
MODULE Demo
    VAR clock c;
    VAR clock d;
    PROC main()
        c := d;  ! -> RG309
    ENDPROC
ENDMODULE
