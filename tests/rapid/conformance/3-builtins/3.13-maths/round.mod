! rule: arguments of Round
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Round(1);
        r_num := Round(1 \Dec:=1);
        r_num := Round();  ! -> RG311
        r_num := Round(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
