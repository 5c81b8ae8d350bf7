! rule: socketdev is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev a;
    VAR socketdev b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
