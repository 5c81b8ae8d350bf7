! rule: arguments of BitXOr
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitXOr(1, 1);
        r_byte := BitXOr(1);  ! -> RG311
        r_byte := BitXOr(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
