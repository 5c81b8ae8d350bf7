! rule: arguments of IsPers
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := IsPers(v_num);
        r_bool := IsPers();  ! -> RG311
        r_bool := IsPers(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
