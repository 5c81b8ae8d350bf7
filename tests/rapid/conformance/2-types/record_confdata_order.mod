! rule: confdata has 4 components
! source: [manual] 3HAC050917
MODULE Demo
    VAR confdata a;
    PROC main()
        a := [1, 1, 1, 1];
        a := [1, 1, 1, 1, 1];  ! -> RG330
    ENDPROC
ENDMODULE
