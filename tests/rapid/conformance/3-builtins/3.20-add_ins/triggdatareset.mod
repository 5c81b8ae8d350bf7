! rule: arguments of TriggDataReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    PROC main()
        TriggDataReset v_triggdata;
        TriggDataReset;  ! -> RG311?
        TriggDataReset v_triggdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
