! rule: arguments of PPMovedInManMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    PROC main()
        result := PPMovedInManMode();
        result := PPMovedInManMode(1);  ! -> RG311
    ENDPROC
ENDMODULE
