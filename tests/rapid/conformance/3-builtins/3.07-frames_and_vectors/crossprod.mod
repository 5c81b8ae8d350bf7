! rule: arguments of CrossProd
! source: [mem]
MODULE Demo
    VAR pos r_pos;
    PROC main()
        r_pos := CrossProd([1, 2, 3], [1, 2, 3]);
        r_pos := CrossProd([1, 2, 3]);  ! -> RG311
        r_pos := CrossProd([1, 2, 3], [1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
