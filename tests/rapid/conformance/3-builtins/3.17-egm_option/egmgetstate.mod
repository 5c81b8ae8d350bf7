! rule: arguments of EGMGetState
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR egmstate r_egmstate;
    PROC main()
        r_egmstate := EGMGetState(v_egmident);
        r_egmstate := EGMGetState();  ! -> RG311
        r_egmstate := EGMGetState(v_egmident \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
