! rule: a number has one point
! source: [K §2.5]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1.2.3;  ! -> RG205
    ENDPROC
ENDMODULE
