! rule: TruncDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Trunc
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := TruncDnum(d);
        n := TruncDnum(d);  ! -> RG307
        d := TruncDnum(n);  ! -> RG307
        d := TruncDnum();  ! -> RG311
    ENDPROC
ENDMODULE
