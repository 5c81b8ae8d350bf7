! rule: arguments of EGMStreamStart
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMStreamStart v_egmident;
        EGMStreamStart v_egmident \SampleRate:=1;
        EGMStreamStart;  ! -> RG311?
        EGMStreamStart v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
