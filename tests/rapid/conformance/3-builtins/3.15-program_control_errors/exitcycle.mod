! rule: arguments of ExitCycle
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool a;
    PROC main()
        IF a ExitCycle;
        IF a ExitCycle 1;  ! -> RG311
    ENDPROC
ENDMODULE
