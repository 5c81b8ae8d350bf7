! rule: arguments of ACos
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ACos(1);
        r_num := ACos();  ! -> RG311
        r_num := ACos(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
