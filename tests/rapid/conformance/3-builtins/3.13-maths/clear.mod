! rule: arguments of Clear
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Clear v_num;
        Clear v_dnum;
        Clear;  ! -> RG311?
        Clear v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
