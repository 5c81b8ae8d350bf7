! rule: arguments of IODisable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IODisable "x", 1;
        IODisable "x";  ! -> RG311
        IODisable "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
