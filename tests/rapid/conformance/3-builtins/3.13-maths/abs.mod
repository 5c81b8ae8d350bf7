! rule: arguments of Abs
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Abs(1);
        r_num := Abs();  ! -> RG311
        r_num := Abs(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
