! rule: named arguments keep the order of the parameters
! source: [K §3.10]
MODULE Demo
    PROC main()
        p b:=2, a:=1;  ! -> RG314
    ENDPROC
    PROC p(num a, num b)
        TPWrite "" \Num:=a + b;
    ENDPROC
ENDMODULE
