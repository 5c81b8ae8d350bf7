! rule: arguments of PathResol
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PathResol 1;
        PathResol;  ! -> RG311?
        PathResol 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
