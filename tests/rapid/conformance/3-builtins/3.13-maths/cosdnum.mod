! rule: CosDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Cos
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := CosDnum(d);
        n := CosDnum(d);  ! -> RG307
        d := CosDnum(n);  ! -> RG307
        d := CosDnum();  ! -> RG311
    ENDPROC
ENDMODULE
