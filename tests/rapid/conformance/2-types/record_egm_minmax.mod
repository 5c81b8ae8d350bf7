! rule: components of egm_minmax
! source: [manual] 3HAC050917
MODULE Demo
    VAR egm_minmax a;
    VAR num n;
    PROC main()
        n := a.min;
        n := a.max;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
