! rule: arguments of Incr
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Incr v_num;
        Incr v_dnum;
        Incr;  ! -> RG311?
        Incr v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
