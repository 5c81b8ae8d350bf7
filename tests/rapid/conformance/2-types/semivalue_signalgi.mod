! rule: signalgi reads as num and is not assigned
! source: [K §2.16]
MODULE Demo
    VAR signalgi a;
    VAR num n;
    PROC main()
        n := a;
        a := 1;  ! -> RG309
    ENDPROC
ENDMODULE
