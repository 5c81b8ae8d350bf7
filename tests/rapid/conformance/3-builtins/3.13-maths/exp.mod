! rule: arguments of Exp
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Exp(1);
        r_num := Exp();  ! -> RG311
        r_num := Exp(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
