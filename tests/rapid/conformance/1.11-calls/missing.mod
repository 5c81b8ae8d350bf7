! rule: each required parameter has an argument
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1;  ! -> RG311
    ENDPROC
    PROC p(num a, num b)
        TPWrite "" \Num:=a + b;
    ENDPROC
ENDMODULE
