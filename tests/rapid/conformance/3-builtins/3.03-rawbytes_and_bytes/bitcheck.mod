! rule: arguments of BitCheck
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := BitCheck(1, 1);
        r_bool := BitCheck(1);  ! -> RG311
        r_bool := BitCheck(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
