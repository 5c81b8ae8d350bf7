! rule: arguments of Dim
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR num r_num;
    PROC main()
        r_num := Dim(v_num, 1);
        r_num := Dim(v_num);  ! -> RG311
        r_num := Dim(v_num, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
