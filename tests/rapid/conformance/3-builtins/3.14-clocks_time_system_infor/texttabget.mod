! rule: arguments of TextTabGet
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := TextTabGet("x");
        r_num := TextTabGet();  ! -> RG311
        r_num := TextTabGet("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
