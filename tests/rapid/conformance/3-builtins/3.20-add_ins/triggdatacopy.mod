! rule: arguments of TriggDataCopy
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    PROC main()
        TriggDataCopy v_triggdata, v_triggdata;
        TriggDataCopy;  ! -> RG311?
        TriggDataCopy v_triggdata, v_triggdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
