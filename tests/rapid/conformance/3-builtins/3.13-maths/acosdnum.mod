! rule: ACosDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of ACos
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ACosDnum(d);
        n := ACosDnum(d);  ! -> RG307
        d := ACosDnum(n);  ! -> RG307
        d := ACosDnum();  ! -> RG311
    ENDPROC
ENDMODULE
