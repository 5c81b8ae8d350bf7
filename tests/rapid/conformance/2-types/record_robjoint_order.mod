! rule: robjoint has 6 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR robjoint a;
    PROC main()
        a := [1, 1, 1, 1, 1, 1];
        a := [1, 1, 1, 1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
