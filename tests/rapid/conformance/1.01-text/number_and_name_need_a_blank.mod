! rule: a separator stands between a number and a name
! source: [K §2.2]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1b;  ! -> RG205
    ENDPROC
ENDMODULE
