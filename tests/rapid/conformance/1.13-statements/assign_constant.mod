! rule: a constant is not assigned
! source: [K §4.4]
MODULE Demo
    CONST num c := 1;
    PROC main()
        c := 2;  ! -> RG310
    ENDPROC
ENDMODULE
