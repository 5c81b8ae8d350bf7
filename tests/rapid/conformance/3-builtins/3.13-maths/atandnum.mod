! rule: ATanDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of ATan
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ATanDnum(d);
        n := ATanDnum(d);  ! -> RG307
        d := ATanDnum(n);  ! -> RG307
        d := ATanDnum();  ! -> RG311
    ENDPROC
ENDMODULE
