! rule: arguments of StrToVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := StrToVal("x", v_num);
        r_bool := StrToVal("x");  ! -> RG311
        r_bool := StrToVal("x", v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
