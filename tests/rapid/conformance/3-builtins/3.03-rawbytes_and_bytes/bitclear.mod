! rule: arguments of BitClear
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte b;
    VAR dnum d;
    PROC main()
        BitClear b, 1;
        BitClear d, 52;
        BitClear b;  ! -> RG311
        BitClear 1, 1;  ! -> RG315
    ENDPROC
ENDMODULE
