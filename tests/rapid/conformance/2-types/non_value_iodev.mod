! rule: iodev is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev a;
    VAR iodev b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
