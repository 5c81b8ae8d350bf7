! rule: arguments of EGMStreamStop
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMStreamStop v_egmident;
        EGMStreamStop;  ! -> RG311?
        EGMStreamStop v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
