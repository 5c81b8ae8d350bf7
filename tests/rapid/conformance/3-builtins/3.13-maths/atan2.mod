! rule: arguments of ATan2
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ATan2(1, 1);
        r_num := ATan2(1);  ! -> RG311
        r_num := ATan2(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
