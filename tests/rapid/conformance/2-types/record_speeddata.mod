! rule: components of speeddata
! source: [manual] 3HAC050917
MODULE Demo
    VAR speeddata a;
    VAR num n;
    PROC main()
        n := a.v_tcp;
        n := a.v_ori;
        n := a.v_leax;
        n := a.v_reax;
        n := a.v_tcp_;  ! -> RG304
    ENDPROC
ENDMODULE
