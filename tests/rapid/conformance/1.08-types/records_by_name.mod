! rule: records are compared by name, not by structure
! source: [K §2.17]
MODULE Demo
    RECORD r
        num x;
    ENDRECORD
    RECORD s
        num x;
    ENDRECORD
    VAR r a;
    VAR s b;
    PROC main()
        a := b;  ! -> RG307
        a := [b.x];
    ENDPROC
ENDMODULE
