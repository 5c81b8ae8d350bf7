! rule: arguments of Tan
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Tan(1);
        r_num := Tan();  ! -> RG311
        r_num := Tan(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
