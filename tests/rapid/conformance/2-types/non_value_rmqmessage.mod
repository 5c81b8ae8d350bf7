! rule: rmqmessage is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqmessage a;
    VAR rmqmessage b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
