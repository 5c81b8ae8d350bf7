! rule: arguments of Decr
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Decr v_num;
        Decr v_dnum;
        Decr;  ! -> RG311?
        Decr v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
