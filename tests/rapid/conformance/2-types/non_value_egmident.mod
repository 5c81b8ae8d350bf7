! rule: egmident is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident a;
    VAR egmident b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
