! rule: whole numbers above 8388608 are not all exact
! source: [K §2.13]
MODULE Demo
    VAR num a;
    PROC main()
        a := 16777217;  ! -> RG319?
    ENDPROC
ENDMODULE
