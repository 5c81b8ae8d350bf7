! rule: components of robjoint
! source: [manual] 3HAC050917
MODULE Demo
    VAR robjoint a;
    VAR num n;
    PROC main()
        n := a.rax_1;
        n := a.rax_2;
        n := a.rax_3;
        n := a.rax_4;
        n := a.rax_5;
        n := a.rax_6;
        n := a.rax_1_;  ! -> RG304
    ENDPROC
ENDMODULE
