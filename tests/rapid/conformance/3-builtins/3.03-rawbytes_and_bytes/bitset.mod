! rule: arguments of BitSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR byte v_byte;
    PROC main()
        BitSet v_byte, 1;
        BitSet v_dnum, 1;
        BitSet v_byte;  ! -> RG311
        BitSet v_byte, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
