! rule: arguments of ValidIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := ValidIO(v_num);
        r_bool := ValidIO();  ! -> RG311
        r_bool := ValidIO(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
