! rule: ASinDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of ASin
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ASinDnum(d);
        n := ASinDnum(d);  ! -> RG307
        d := ASinDnum(n);  ! -> RG307
        d := ASinDnum();  ! -> RG311
    ENDPROC
ENDMODULE
