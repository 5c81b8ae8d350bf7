! rule: arguments of TriggDataValid
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r;
    VAR triggdata v_triggdata;
    PROC main()
        r := TriggDataValid(v_triggdata);
        r := TriggDataValid();  ! -> RG311
        r := TriggDataValid(v_triggdata \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
