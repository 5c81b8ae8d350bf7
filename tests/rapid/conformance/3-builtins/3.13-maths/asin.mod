! rule: arguments of ASin
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ASin(1);
        r_num := ASin();  ! -> RG311
        r_num := ASin(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
