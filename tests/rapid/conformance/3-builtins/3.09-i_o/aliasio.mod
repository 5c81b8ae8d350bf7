! rule: arguments of AliasIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        AliasIO v_num, v_num;
        AliasIO v_num;  ! -> RG311
        AliasIO v_num, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
