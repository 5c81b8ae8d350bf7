! rule: PowDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its arguments as of Pow
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := PowDnum(d, n);
        n := PowDnum(d, n);  ! -> RG307
        d := PowDnum(d, d);  ! -> RG307
        d := PowDnum(d);  ! -> RG311
    ENDPROC
ENDMODULE
