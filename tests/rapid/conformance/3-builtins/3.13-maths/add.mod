! rule: arguments of Add
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Add v_num, 1;
        Add v_dnum, 1;
        Add v_num;  ! -> RG311
        Add v_num, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
