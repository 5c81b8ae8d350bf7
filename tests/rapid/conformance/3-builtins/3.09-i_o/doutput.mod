! rule: arguments of DOutput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    VAR dionum r_dionum;
    PROC main()
        r_dionum := DOutput(v_signaldo);
        r_dionum := DOutput();  ! -> RG311
        r_dionum := DOutput(v_signaldo \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
