! rule: arguments of Present
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := Present(v_num);
        r_bool := Present();  ! -> RG311
        r_bool := Present(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
