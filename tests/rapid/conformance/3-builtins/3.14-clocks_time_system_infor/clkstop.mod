! rule: arguments of ClkStop
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    PROC main()
        ClkStop v_clock;
        ClkStop;  ! -> RG311?
        ClkStop v_clock \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
