! rule: arguments of GetTrapData
! source: [manual] 3HAC050917
MODULE Demo
    VAR trapdata v_trapdata;
    PROC main()
        GetTrapData v_trapdata;
        GetTrapData;  ! -> RG311?
        GetTrapData v_trapdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
