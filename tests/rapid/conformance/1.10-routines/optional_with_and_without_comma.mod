! rule: a comma before an optional parameter is free
! source: [K §5.1]
MODULE Demo
    PROC main()
        p 1 \b:=2 \c:=3;
    ENDPROC
    PROC p(num a \num b, \num c)
        IF Present(b) AND Present(c) a := b + c;
    ENDPROC
ENDMODULE
