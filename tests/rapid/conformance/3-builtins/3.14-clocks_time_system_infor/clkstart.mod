! rule: arguments of ClkStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    PROC main()
        ClkStart v_clock;
        ClkStart;  ! -> RG311?
        ClkStart v_clock \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
