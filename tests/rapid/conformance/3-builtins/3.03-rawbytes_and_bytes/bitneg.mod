! rule: arguments of BitNeg
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := BitNeg(1);
        r_byte := BitNeg();  ! -> RG311
        r_byte := BitNeg(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
