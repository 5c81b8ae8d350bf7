! rule: arguments of Min
! source: [mem]
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Min(1, 1);
        r_num := Min(1);  ! -> RG311
        r_num := Min(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
