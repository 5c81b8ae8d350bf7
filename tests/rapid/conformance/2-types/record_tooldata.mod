! rule: components of tooldata
! source: [manual] 3HAC050917
MODULE Demo
    VAR tooldata a;
    VAR num n;
    PROC main()
        n := a.tframe.trans.x;
        n := a.tload.mass;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
