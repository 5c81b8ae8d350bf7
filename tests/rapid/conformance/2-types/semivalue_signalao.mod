! rule: signalao reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signalao a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
