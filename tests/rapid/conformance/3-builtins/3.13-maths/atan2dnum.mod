! rule: ATan2Dnum takes and gives dnum
! source: [manual] 3HAC050917, name; its arguments as of ATan2
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ATan2Dnum(d, d);
        n := ATan2Dnum(d, d);  ! -> RG307
        d := ATan2Dnum(d, n);  ! -> RG307
        d := ATan2Dnum(d);  ! -> RG311
    ENDPROC
ENDMODULE
