! rule: arguments of RemoveSuperv
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signaldi v_signaldi;
    PROC main()
        RemoveSuperv v_signaldi, v_num, v_num;
        RemoveSuperv;  ! -> RG311?
    ENDPROC
ENDMODULE
