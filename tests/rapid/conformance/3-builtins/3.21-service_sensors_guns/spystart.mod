! rule: arguments of SpyStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        SpyStart v_string;
        SpyStart;  ! -> RG311?
    ENDPROC
ENDMODULE
