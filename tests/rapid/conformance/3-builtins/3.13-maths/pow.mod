! rule: arguments of Pow
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Pow(1, 1);
        r_num := Pow(1);  ! -> RG311
        r_num := Pow(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
