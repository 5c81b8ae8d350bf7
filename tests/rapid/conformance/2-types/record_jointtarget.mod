! rule: components of jointtarget
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget a;
    VAR num n;
    PROC main()
        n := a.robax.rax_1;
        n := a.extax.eax_a;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
