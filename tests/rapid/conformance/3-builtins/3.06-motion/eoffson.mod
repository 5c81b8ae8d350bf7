! rule: arguments of EOffsOn
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PROC main()
        EOffsOn v_robtarget;
        EOffsOn \ExeP:=v_robtarget, v_robtarget;
        EOffsOn;  ! -> RG311?
        EOffsOn v_robtarget \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
