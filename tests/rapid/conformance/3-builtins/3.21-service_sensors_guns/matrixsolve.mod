! rule: arguments of MatrixSolve
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum_2x2{2,2};
    VAR dnum v_dnum_2{2};
    VAR num v_num;
    PROC main()
        MatrixSolve v_dnum_2x2, v_dnum_2, v_dnum_2;
        MatrixSolve v_dnum_2x2 \A_m:=v_num \A_n:=v_num, v_dnum_2, v_dnum_2;
        MatrixSolve;  ! -> RG311?
    ENDPROC
ENDMODULE
