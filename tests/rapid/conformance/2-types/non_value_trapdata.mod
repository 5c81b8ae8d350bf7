! rule: trapdata is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR trapdata a;
    VAR trapdata b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
