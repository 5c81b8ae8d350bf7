! rule: arguments of Sin
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Sin(1);
        r_num := Sin();  ! -> RG311
        r_num := Sin(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
