! rule: arguments of IsVar
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := IsVar(v_num);
        r_bool := IsVar();  ! -> RG311
        r_bool := IsVar(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
