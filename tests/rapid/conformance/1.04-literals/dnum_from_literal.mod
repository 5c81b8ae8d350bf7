! rule: a literal becomes dnum where dnum is wanted
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum a;
    PROC main()
        a := 4503599627370496;
        a := 1;
    ENDPROC
ENDMODULE
