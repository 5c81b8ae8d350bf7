! rule: mecunit is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit a;
    VAR mecunit b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
