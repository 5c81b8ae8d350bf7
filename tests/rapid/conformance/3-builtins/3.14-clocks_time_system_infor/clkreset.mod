! rule: arguments of ClkReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    PROC main()
        ClkReset v_clock;
        ClkReset;  ! -> RG311?
        ClkReset v_clock \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
