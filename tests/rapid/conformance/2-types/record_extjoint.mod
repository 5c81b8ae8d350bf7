! rule: components of extjoint
! source: [manual] 3HAC050917
MODULE Demo
    VAR extjoint a;
    VAR num n;
    PROC main()
        n := a.eax_a;
        n := a.eax_b;
        n := a.eax_c;
        n := a.eax_d;
        n := a.eax_e;
        n := a.eax_f;
        n := a.eax_a_;  ! -> RG304
    ENDPROC
ENDMODULE
