! rule: components behind an element, and chains
! source: [K §3.5]
MODULE Demo
    VAR pose a{2};
    VAR num b;
    PROC main()
        a{2}.trans.x := 1;
        b := a{1}.rot.q1;
    ENDPROC
ENDMODULE
