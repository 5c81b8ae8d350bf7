! rule: a comment may contain tabs
! source: [K §2.10]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1;	!	b := ;	ENDPROC
        b := a;
        a := b;
    ENDPROC
ENDMODULE
