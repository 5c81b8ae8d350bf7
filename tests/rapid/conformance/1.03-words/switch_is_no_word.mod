! rule: switch is a type name, not reserved
! source: [K §2.4, 5.1]
MODULE Demo
    VAR num switch;
    VAR num a;
    PROC main()
        switch := 1;
        a := switch;
    ENDPROC
ENDMODULE
