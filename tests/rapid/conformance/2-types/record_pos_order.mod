! rule: pos has 3 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR pos a;
    PROC main()
        a := [1, 1, 1];
        a := [1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
