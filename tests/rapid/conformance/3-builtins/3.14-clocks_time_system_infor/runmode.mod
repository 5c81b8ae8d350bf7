! rule: arguments of RunMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR symnum r_symnum;
    PROC main()
        r_symnum := RunMode();
        r_symnum := RunMode(\Main);
        r_symnum := RunMode(1);  ! -> RG311
        r_symnum := RunMode(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
