! rule: clock is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock a;
    VAR clock b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
