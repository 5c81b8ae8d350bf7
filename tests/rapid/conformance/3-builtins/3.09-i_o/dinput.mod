! rule: arguments of DInput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldi v_signaldi;
    VAR dionum r_dionum;
    PROC main()
        r_dionum := DInput(v_signaldi);
        r_dionum := DInput();  ! -> RG311
        r_dionum := DInput(v_signaldi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
