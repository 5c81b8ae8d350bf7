! rule: nothing is converted
! source: [K §2.17]
MODULE Demo
    VAR num a;
    VAR dnum b;
    PROC main()
        a := b;  ! -> RG307
    ENDPROC
ENDMODULE
