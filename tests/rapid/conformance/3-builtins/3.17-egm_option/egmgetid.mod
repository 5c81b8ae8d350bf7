! rule: arguments of EGMGetId
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMGetId v_egmident;
        EGMGetId;  ! -> RG311?
        EGMGetId v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
