! rule: dir is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir a;
    VAR dir b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
