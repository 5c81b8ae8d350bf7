! rule: SqrtDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Sqrt
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := SqrtDnum(d);
        n := SqrtDnum(d);  ! -> RG307
        d := SqrtDnum(n);  ! -> RG307
        d := SqrtDnum();  ! -> RG311
    ENDPROC
ENDMODULE
