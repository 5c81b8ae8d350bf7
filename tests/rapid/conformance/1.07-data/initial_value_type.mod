! rule: an initial value has the type of its datum
! source: [K §2.22]
MODULE Demo
    VAR num a := TRUE;  ! -> RG307
    PROC main()
        a := 1;
    ENDPROC
ENDMODULE
