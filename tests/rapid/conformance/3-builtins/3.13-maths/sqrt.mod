! rule: arguments of Sqrt
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Sqrt(1);
        r_num := Sqrt();  ! -> RG311
        r_num := Sqrt(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
