! rule: components of stoppointdata
! source: [manual] 3HAC050917
MODULE Demo
    VAR stoppointdata a;
    VAR num n;
    PROC main()
        n := a.inpos.position;
        n := a.stoptime;
        n := a.followtime;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
