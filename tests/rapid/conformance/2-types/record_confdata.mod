! rule: components of confdata
! source: [manual] 3HAC050917
MODULE Demo
    VAR confdata a;
    VAR num n;
    PROC main()
        n := a.cf1;
        n := a.cf4;
        n := a.cf6;
        n := a.cfx;
        n := a.cf1_;  ! -> RG304
    ENDPROC
ENDMODULE
