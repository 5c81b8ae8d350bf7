! rule: loadsession is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession a;
    VAR loadsession b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
