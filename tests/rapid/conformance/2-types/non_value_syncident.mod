! rule: syncident is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR syncident a;
    VAR syncident b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
