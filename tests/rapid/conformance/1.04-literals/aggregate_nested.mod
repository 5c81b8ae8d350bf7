! rule: aggregates nest, and members may be expressions
! source: [K §3.9]
MODULE Demo
    VAR pose p;
    VAR num a;
    PROC main()
        p := [[a + 1, 2, -a], OrientZYX(0, 0, a)];
    ENDPROC
ENDMODULE
