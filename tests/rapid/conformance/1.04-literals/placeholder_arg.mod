! rule: <ARG> stands for an argument
! source: [K §2.9, 4.5]
MODULE Demo
    PROC main()
        TPWrite <ARG>;
    ENDPROC
ENDMODULE
