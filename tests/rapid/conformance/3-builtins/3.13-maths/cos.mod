! rule: arguments of Cos
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Cos(1);
        r_num := Cos();  ! -> RG311
        r_num := Cos(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
