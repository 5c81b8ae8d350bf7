! rule: rmqslot is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot a;
    VAR rmqslot b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
