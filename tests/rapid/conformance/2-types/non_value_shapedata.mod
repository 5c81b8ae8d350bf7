! rule: shapedata is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR shapedata a;
    VAR shapedata b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
