! rule: TanDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Tan
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := TanDnum(d);
        n := TanDnum(d);  ! -> RG307
        d := TanDnum(n);  ! -> RG307
        d := TanDnum();  ! -> RG311
    ENDPROC
ENDMODULE
