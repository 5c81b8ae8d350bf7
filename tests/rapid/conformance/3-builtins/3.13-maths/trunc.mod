! rule: arguments of Trunc
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Trunc(1);
        r_num := Trunc(1 \Dec:=1);
        r_num := Trunc();  ! -> RG311
        r_num := Trunc(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
