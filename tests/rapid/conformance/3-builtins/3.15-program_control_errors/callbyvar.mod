! rule: arguments of CallByVar
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        CallByVar "x", 1;
        CallByVar "x";  ! -> RG311
        CallByVar "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
