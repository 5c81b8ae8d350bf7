! rule: no datum behind a routine
! source: [K §5, 9.1]
MODULE Demo
    PROC main()
    ENDPROC
    VAR num a;  ! -> RG213
ENDMODULE
