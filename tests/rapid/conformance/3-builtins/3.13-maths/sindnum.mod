! rule: SinDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Sin
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := SinDnum(d);
        n := SinDnum(d);  ! -> RG307
        d := SinDnum(n);  ! -> RG307
        d := SinDnum();  ! -> RG311
    ENDPROC
ENDMODULE
