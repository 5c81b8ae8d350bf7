! rule: space, tab, form feed and newline separate alike
! source: [K §2.2]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a
        :=	1        ;
    ENDPROC
ENDMODULE
