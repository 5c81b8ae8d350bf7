! rule: behind a leading NOT one sign may stand, not two; a row of prefixes is told once
! source: [K §3]
MODULE Demo
    VAR bool a;
    VAR num b;
    PROC main()
        a := NOT (- b < 1);
        a := NOT (- - b < 1);  ! -> RG212?
        a := NOT - b < 1;
        a := NOT - - b < 1;  ! -> RG212?
        b := - - - - b;  ! -> RG212?
    ENDPROC
ENDMODULE
