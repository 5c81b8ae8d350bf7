! rule: a required argument may be named
! source: [K §3.10]
MODULE Demo
    PROC main()
        p a:=1, b:=2;
        p 1, b:=2;
    ENDPROC
    PROC p(num a, num b)
        TPWrite "" \Num:=a + b;
    ENDPROC
ENDMODULE
