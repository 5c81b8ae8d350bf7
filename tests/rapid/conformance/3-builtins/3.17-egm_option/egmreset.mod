! rule: arguments of EGMReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMReset v_egmident;
        EGMReset;  ! -> RG311?
        EGMReset v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
