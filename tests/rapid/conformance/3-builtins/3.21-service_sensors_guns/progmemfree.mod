! rule: arguments of ProgMemFree
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    PROC main()
        result := ProgMemFree();
        result := ProgMemFree(1);  ! -> RG311
    ENDPROC
ENDMODULE
