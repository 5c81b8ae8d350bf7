! rule: components of orient
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient a;
    VAR num n;
    PROC main()
        n := a.q1;
        n := a.q2;
        n := a.q3;
        n := a.q4;
        n := a.q1_;  ! -> RG304
    ENDPROC
ENDMODULE
