! rule: components of progdisp
! source: [manual] 3HAC050917
MODULE Demo
    VAR progdisp a;
    VAR num n;
    PROC main()
        n := a.pdisp.trans.x;
        n := a.eoffs.eax_a;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
