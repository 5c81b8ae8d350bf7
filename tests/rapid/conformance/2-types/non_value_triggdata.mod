! rule: triggdata is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata a;
    VAR triggdata b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
