! rule: arguments of PathLevel
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := PathLevel();
        r_num := PathLevel(1);  ! -> RG311
        r_num := PathLevel(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
