! rule: components of wobjdata
! source: [manual] 3HAC050917
MODULE Demo
    VAR wobjdata a;
    VAR num n;
    PROC main()
        n := a.uframe.trans.x;
        n := a.oframe.rot.q4;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
