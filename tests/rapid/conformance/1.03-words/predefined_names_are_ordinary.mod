! rule: predefined names may be declared anew
! source: [K §2.12, 2.20, 5.2]
MODULE Demo
    VAR num a;
    PROC main()
        VAR num Stop;
        Stop := 1;
        a := Stop;
    ENDPROC
ENDMODULE
