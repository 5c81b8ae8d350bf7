! rule: a VAR of a routine starts from a constant expression
! source: [K §2.22]
MODULE Demo
    PROC main()
        p 1;
    ENDPROC
    PROC p(num n)
        VAR num a := n;  ! -> RG317
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
