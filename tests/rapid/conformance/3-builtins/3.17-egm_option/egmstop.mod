! rule: arguments of EGMStop
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMStop v_egmident, 1;
        EGMStop v_egmident, 1 \RampOutTime:=1;
        EGMStop v_egmident;  ! -> RG311
        EGMStop v_egmident, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
