! rule: arguments of IsFile
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsFile("x");
        r_bool := IsFile("x" \Directory);
        r_bool := IsFile("x" \Fifo);
        r_bool := IsFile("x" \RegFile);
        r_bool := IsFile("x" \BlockSpec);
        r_bool := IsFile("x" \CharSpec);
        r_bool := IsFile();  ! -> RG311
        r_bool := IsFile("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
