! rule: arguments of OpMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR symnum r_symnum;
    PROC main()
        r_symnum := OpMode();
        r_symnum := OpMode(1);  ! -> RG311
        r_symnum := OpMode(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
