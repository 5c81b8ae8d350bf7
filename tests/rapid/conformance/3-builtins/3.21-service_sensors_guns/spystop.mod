! rule: arguments of SpyStop
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SpyStop;
        SpyStop 1;  ! -> RG311?
    ENDPROC
ENDMODULE
