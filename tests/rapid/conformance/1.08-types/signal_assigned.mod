! rule: a signal is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signaldo do1;
    PROC main()
        do1 := 1;  ! -> RG309
    ENDPROC
ENDMODULE
