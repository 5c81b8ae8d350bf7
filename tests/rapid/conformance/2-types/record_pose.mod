! rule: components of pose
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose a;
    VAR num n;
    PROC main()
        n := a.trans.x;
        n := a.rot.q1;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
