! rule: arguments of TestAndSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR bool r_bool;
    PROC main()
        r_bool := TestAndSet(v_bool);
        r_bool := TestAndSet();  ! -> RG311
        r_bool := TestAndSet(v_bool \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
