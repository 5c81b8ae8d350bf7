! rule: arguments of ATan
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ATan(1);
        r_num := ATan();  ! -> RG311
        r_num := ATan(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
