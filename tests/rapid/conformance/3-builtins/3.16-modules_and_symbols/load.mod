! rule: arguments of Load
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        Load "x";
        Load \Dynamic, "x" \File:="x" \CheckRef;
        Load;  ! -> RG311?
        Load "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
