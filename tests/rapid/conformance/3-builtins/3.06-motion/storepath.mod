! rule: arguments of StorePath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StorePath;
        StorePath \KeepSync;
        StorePath 1;  ! -> RG311
        StorePath \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
