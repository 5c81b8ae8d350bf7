! rule: arguments of Max
! source: [mem]
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Max(1, 1);
        r_num := Max(1);  ! -> RG311
        r_num := Max(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
