! rule: arguments of PFRestart
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    PROC main()
        result := PFRestart();
        result := PFRestart(\Base);
        result := PFRestart(1);  ! -> RG311
    ENDPROC
ENDMODULE
