! rule: arguments of UIClientExist
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := UIClientExist();
        r_bool := UIClientExist(1);  ! -> RG311
        r_bool := UIClientExist(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
