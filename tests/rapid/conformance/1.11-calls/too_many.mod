! rule: no argument without a parameter
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1, 2;  ! -> RG311
    ENDPROC
    PROC p(num a)
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
