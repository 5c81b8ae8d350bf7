! rule: arguments of Distance
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Distance([1, 2, 3], [1, 2, 3]);
        r_num := Distance([1, 2, 3]);  ! -> RG311
        r_num := Distance([1, 2, 3], [1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
