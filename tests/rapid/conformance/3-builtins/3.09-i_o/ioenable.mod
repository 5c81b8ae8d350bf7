! rule: arguments of IOEnable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IOEnable "x", 1;
        IOEnable "x";  ! -> RG311
        IOEnable "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
