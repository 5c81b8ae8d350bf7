! rule: components of robtarget
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget a;
    VAR num n;
    PROC main()
        n := a.trans.x;
        n := a.rot.q1;
        n := a.robconf.cf1;
        n := a.extax.eax_f;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
