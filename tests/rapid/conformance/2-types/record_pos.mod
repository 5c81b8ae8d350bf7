! rule: components of pos
! source: [manual] 3HAC050917
MODULE Demo
    VAR pos a;
    VAR num n;
    PROC main()
        n := a.x;
        n := a.y;
        n := a.z;
        n := a.x_;  ! -> RG304
    ENDPROC
ENDMODULE
