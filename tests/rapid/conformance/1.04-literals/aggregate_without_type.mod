! rule: two aggregates have no type
! source: [K §3.9]
MODULE Demo
    VAR bool a;
    PROC main()
        a := [1, 2, 3] = [1, 2, 3];  ! -> RG330
    ENDPROC
ENDMODULE
