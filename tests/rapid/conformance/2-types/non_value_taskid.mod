! rule: taskid is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid a;
    VAR taskid b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
