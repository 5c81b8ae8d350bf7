! rule: components of loaddata
! source: [manual] 3HAC050917
MODULE Demo
    VAR loaddata a;
    VAR num n;
    PROC main()
        n := a.mass;
        n := a.cog.x;
        n := a.aom.q1;
        n := a.ix;
        n := a.iy;
        n := a.iz;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
